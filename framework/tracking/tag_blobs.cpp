#include <algorithm>
#include <limits>
#include <numeric>

#include "tracking/candidate_generator.hpp"

namespace maggic::tracking {
namespace {

// Two patches that run into each other, with what blur adds or the seam takes away.
constexpr double kMergedMinRatio = 1.45;
constexpr double kMergedMaxRatio = 2.7;
// A frame that is noise all over must not cost seconds: the largest blobs are looked at.
constexpr std::size_t kMaxBlobs = 2000;

}  // namespace

TagBlobs::TagBlobs(const TrackingParameters& parameters, std::span<const LayoutModel> layouts)
    : parameters_(parameters), layouts_(layouts) {
  min_area_mm2_ = std::numeric_limits<double>::max();
  for (const LayoutModel& layout : layouts) {
    for (const PatchModel& patch : layout.patches) {
      min_area_mm2_ = std::min(min_area_mm2_, patch.area_mm2 * parameters.patch_min_area_ratio);
      max_area_mm2_ =
          std::max(max_area_mm2_,
                   patch.area_mm2 * std::max(kMergedMaxRatio, parameters.patch_max_area_ratio));
    }
    for (const TagId& entry : layout.ids) {
      for (const Label color : entry.colors) listed_[color] = true;
    }
  }
  blobs_.reserve(256);
}

void TagBlobs::load(std::span<const Blob> blobs, const Field& field) {
  const double height_mm = field.robot_height_mm();
  const AreaSieve sieve(field, height_mm, min_area_mm2_, max_area_mm2_);
  blobs_.clear();
  source_count_ = static_cast<int>(blobs.size());
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    if (!sieve.passes(blob) || (!is_team_color(blob.label) && !may_be_player(blob.label))) continue;
    const MetricBlob metric = to_metric(blob, i, field, height_mm);
    if (metric.area_mm2 < min_area_mm2_ || metric.area_mm2 > max_area_mm2_) continue;
    blobs_.push_back(metric);
  }
  const auto by_area = [](const MetricBlob& a, const MetricBlob& b) {
    return a.area_mm2 != b.area_mm2 ? a.area_mm2 > b.area_mm2 : a.source < b.source;
  };
  is_cut_short_ = blobs_.size() > kMaxBlobs;
  if (is_cut_short_) {
    std::ranges::nth_element(blobs_, blobs_.begin() + kMaxBlobs, by_area);
    blobs_.resize(kMaxBlobs);
  }
  for (std::size_t i = 0, whole = blobs_.size(); i < whole; ++i) add_halves(MetricBlob(blobs_[i]));
  sort_by_position();
}

void TagBlobs::sort_by_position() {
  order_.resize(blobs_.size());
  std::iota(order_.begin(), order_.end(), 0);
  // Position before source: the answer must not depend on the order blobs come in.
  std::ranges::sort(order_, [&](int first, int second) {
    const MetricBlob& a = blobs_[static_cast<std::size_t>(first)];
    const MetricBlob& b = blobs_[static_cast<std::size_t>(second)];
    if (a.position_mm.x != b.position_mm.x) return a.position_mm.x < b.position_mm.x;
    if (a.position_mm.y != b.position_mm.y) return a.position_mm.y < b.position_mm.y;
    return a.source != b.source ? a.source < b.source : a.parts < b.parts;
  });
  sorted_.clear();
  xs_mm_.clear();
  for (const int index : order_) {
    const MetricBlob& blob = blobs_[static_cast<std::size_t>(index)];
    sorted_.push_back(blob);
    xs_mm_.push_back(blob.position_mm.x);
  }
}

void TagBlobs::add_halves(const MetricBlob& blob) {
  const bool team = is_team_color(blob.label);
  for (const LayoutModel& layout : layouts_) {
    for (std::size_t i = 0; i < layout.patches.size(); ++i) {
      const PatchModel& patch = layout.patches[i];
      const double ratio = blob.area_mm2 / patch.area_mm2;
      if ((i == 0) != team || ratio < kMergedMinRatio || ratio > kMergedMaxRatio) continue;
      MetricBlob first;
      MetricBlob second;
      if (!split_in_two(blob, patch.variance_mm2, first, second)) continue;
      blobs_.push_back(first);
      blobs_.push_back(second);
      return;
    }
  }
}

std::pair<int, int> TagBlobs::within_x(double x_mm, double reach_mm) const {
  const auto first = std::ranges::lower_bound(xs_mm_, x_mm - reach_mm);
  const auto last = std::upper_bound(first, xs_mm_.end(), x_mm + reach_mm);
  return {static_cast<int>(first - xs_mm_.begin()), static_cast<int>(last - xs_mm_.begin())};
}

bool TagBlobs::is_team_color(Label label) const {
  return label != kBackground &&
         (label == parameters_.blue_team_color || label == parameters_.yellow_team_color);
}

bool TagBlobs::may_be_player(Label label) const {
  if (listed_[label]) return true;
  return label != kBackground && !is_team_color(label) && label != parameters_.ball_color;
}

bool TagBlobs::fits_area(const PatchModel& patch, const MetricBlob& blob) const {
  const double ratio = blob.area_mm2 / patch.area_mm2;
  return ratio >= parameters_.patch_min_area_ratio && ratio <= parameters_.patch_max_area_ratio;
}

}  // namespace maggic::tracking
