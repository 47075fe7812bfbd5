#include "calibration/pattern_candidates.hpp"

#include <algorithm>
#include <cmath>

namespace maggic::calibration {
namespace {

// Limits of belief; a misfit of 1 is one of them reached.
constexpr double kMaxPlaceErrorMm = 14.0;
constexpr double kMaxAreaRatio = 2.2;   // between a patch and what the scale makes of its layout
constexpr double kMaxScaleRatio = 1.5;  // between the scale areas give and the scale distances give
constexpr double kMaxSpacing = 3.2;     // of the patches' side: farther ones are not tried

double log_ratio(double a, double b) { return std::abs(std::log(a / b)); }

/// Least-squares similarity without mirroring, complex: picture = turn · layout + shift.
struct Similarity {
  cv::Point2d turn;  // scale and rotation as a complex number, px a mm
  cv::Point2d shift;

  cv::Point2d apply(cv::Point2d p) const {
    return {turn.x * p.x - turn.y * p.y + shift.x, turn.x * p.y + turn.y * p.x + shift.y};
  }
  double scale() const { return std::hypot(turn.x, turn.y); }
};

Similarity fit_similarity(std::span<const cv::Point2d> from, std::span<const cv::Point2d> to) {
  cv::Point2d from_mean;
  cv::Point2d to_mean;
  const auto count = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i] / count;
    to_mean += to[i] / count;
  }
  double squares = 0.0;
  cv::Point2d sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Point2d a = from[i] - from_mean;
    const cv::Point2d b = to[i] - to_mean;
    squares += a.dot(a);
    sum += cv::Point2d(a.dot(b), a.cross(b));
  }
  Similarity fit{sum / squares, {}};
  fit.shift = to_mean - (fit.apply(from_mean));
  return fit;
}

class CandidateLister {
 public:
  CandidateLister(std::span<const Patch> patches, const std::optional<TagMetric>& metric,
                  std::vector<PatternCandidate>& out)
      : patches_(patches), metric_(metric), out_(out) {
    // y up, so that a layout is not mirrored; in millimetres where the metric is known.
    const cv::Matx22d map = metric ? metric->mm_per_px() : cv::Matx22d::eye();
    unit_mm2_ = metric ? metric->pixel_mm2() : 1.0;
    for (const Patch& patch : patches) {
      const cv::Vec2d p = map * cv::Vec2d(patch.centroid_px.x, patch.centroid_px.y);
      places_.push_back({p[0], -p[1]});
      areas_.push_back(patch.area_px * unit_mm2_);
    }
  }

  void list(const TagLayout& layout, int index) {
    layout_ = &layout;
    candidate_ = {};
    candidate_.layout = index;
    centers_.clear();
    for (const TagPatch& patch : layout.patches) centers_.push_back(patch.center_mm);
    extend();
  }

 private:
  void extend() {
    const std::size_t next = candidate_.patches.size();
    if (next == layout_->patches.size()) {
      finish();
      return;
    }
    for (int p = 0; p < static_cast<int>(patches_.size()); ++p) {
      if (std::ranges::count(candidate_.patches, p) > 0 || !may_follow(p)) continue;
      candidate_.patches.push_back(p);
      extend();
      candidate_.patches.pop_back();
    }
  }

  /// Quick sieve: near enough, and of an area that goes with the first one's.
  bool may_follow(int p) const {
    const auto at = [&](int i) { return static_cast<std::size_t>(i); };
    const std::size_t next = candidate_.patches.size();
    const double expected = layout_->patches[next].expected_area_mm2();
    if (metric_ && log_ratio(areas_[at(p)], expected) > std::log(kMaxAreaRatio)) return false;
    if (next == 0) return true;
    const int first = candidate_.patches[0];
    const cv::Point2d apart = places_[at(p)] - places_[at(first)];
    const double side = std::sqrt(std::max(areas_[at(p)], areas_[at(first)]));
    if (std::hypot(apart.x, apart.y) > kMaxSpacing * side) return false;
    const double ratio = areas_[at(p)] / areas_[at(first)];
    return log_ratio(ratio, expected / layout_->patches[0].expected_area_mm2()) <=
           std::log(kMaxAreaRatio);
  }

  void finish() {
    boost::container::static_vector<cv::Point2d, kMaxPatches> seen;
    double area = 0.0;
    double expected_area = 0.0;
    for (std::size_t i = 0; i < candidate_.patches.size(); ++i) {
      const auto p = static_cast<std::size_t>(candidate_.patches[i]);
      seen.push_back(places_[p]);
      area += areas_[p];
      expected_area += layout_->patches[i].expected_area_mm2();
    }
    const Similarity fit =
        fit_similarity({centers_.data(), centers_.size()}, {seen.data(), seen.size()});
    const double scale = fit.scale();
    if (scale <= 0.0) return;
    const double from_areas = std::sqrt(area / expected_area);
    double misfit = std::pow(log_ratio(scale, from_areas) / std::log(kMaxScaleRatio), 2);
    if (metric_) misfit += std::pow(std::log(scale) / std::log(kMaxScaleRatio), 2);
    if (misfit > 1.0) return;
    double place = 0.0;
    double areas = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const cv::Point2d off = seen[i] - fit.apply(centers_[i]);
      place = std::max(place, std::hypot(off.x, off.y) / (scale * kMaxPlaceErrorMm));
      const double expected = layout_->patches[i].expected_area_mm2() * scale * scale;
      areas = std::max(
          areas, log_ratio(areas_[static_cast<std::size_t>(candidate_.patches[i])], expected) /
                     std::log(kMaxAreaRatio));
    }
    if (place > 1.0 || areas > 1.0) return;
    candidate_.misfit = std::sqrt((misfit + place * place + areas * areas) / 3.0);
    // Areas average over the whole tag; with two patches the distance is one number only.
    candidate_.mm_per_px = std::sqrt(unit_mm2_) / std::sqrt(scale * from_areas);
    out_.push_back(candidate_);
  }

  std::span<const Patch> patches_;
  const std::optional<TagMetric>& metric_;
  std::vector<PatternCandidate>& out_;
  double unit_mm2_ = 1.0;
  std::vector<cv::Point2d> places_;
  std::vector<double> areas_;
  const TagLayout* layout_ = nullptr;
  boost::container::static_vector<cv::Point2d, kMaxPatches> centers_;
  PatternCandidate candidate_;
};

}  // namespace

std::vector<PatternCandidate> list_candidates(std::span<const Patch> patches,
                                              std::span<const TagLayout> layouts,
                                              const std::optional<TagMetric>& metric) {
  std::vector<PatternCandidate> candidates;
  CandidateLister lister(patches, metric, candidates);
  for (std::size_t i = 0; i < layouts.size(); ++i) lister.list(layouts[i], static_cast<int>(i));
  return candidates;
}

std::vector<const PatternCandidate*> choose_apart(std::span<const PatternCandidate> candidates,
                                                  std::size_t patch_count) {
  std::vector<const PatternCandidate*> order;
  for (const PatternCandidate& candidate : candidates) order.push_back(&candidate);
  std::ranges::stable_sort(order, [](const auto* a, const auto* b) {
    // A pattern of more patches explains more than one of fewer.
    if (a->patches.size() != b->patches.size()) return a->patches.size() > b->patches.size();
    return a->misfit < b->misfit;
  });
  std::vector<bool> taken(patch_count, false);
  std::vector<const PatternCandidate*> chosen;
  for (const PatternCandidate* candidate : order) {
    const auto is_taken = [&](int p) { return taken[static_cast<std::size_t>(p)]; };
    if (std::ranges::any_of(candidate->patches, is_taken)) continue;
    for (const int p : candidate->patches) taken[static_cast<std::size_t>(p)] = true;
    chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace maggic::calibration
