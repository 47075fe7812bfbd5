#include "calibration/field_finder.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "calibration/field_model.hpp"
#include "calibration/ridge_map.hpp"

namespace maggic::calibration {
namespace {

constexpr int kMinContrast = 10;           // 8-bit steps between a line and the floor
constexpr double kWidestLineMm = 40.0;     // the top of a wall
constexpr double kThinnestWallMm = 11.0;   // lines are narrower, blur included
constexpr double kShortestLineMm = 110.0;  // a goal area's side, less what is hidden of it
// What the lines may make of the scale the tags suggest: tags are nearer to the camera than the
// floor, blur makes them larger, and teams cut them by hand.
constexpr double kMinScaleRatio = 0.85;
constexpr double kMaxScaleRatio = 1.35;
constexpr double kMaxStretchRatio = 1.2;  // between both axes, beyond what the tags say
constexpr double kCaptureMm = 8.0;        // a line this far from its place supports a hypothesis
constexpr double kLineSeen = 0.5;         // of its points, for the line to count as seen
constexpr double kMinSeenShare = 0.4;
// Noise has crests everywhere; they lie off by 0.58 of the reach (evenly spread, RMS), lines by
// less.
constexpr double kMostlyChance = 0.4;
constexpr double kMinLensGain = 0.93;  // a lens has to lower the error to this, at least

using Corners = std::array<cv::Point2d, 4>;

/// Meeting point of an upright and a level line.
cv::Point2d meet(const SeenLine& upright, const SeenLine& level, cv::Point2d middle) {
  // x = a + s (y - my), y = b + t (x - mx)
  const double y = (level.position_px +
                    level.slope * (upright.position_px - middle.x - upright.slope * middle.y)) /
                   (1.0 - level.slope * upright.slope);
  return {upright.position_px + upright.slope * (y - middle.y), y};
}

cv::Point2d through(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1.0);
  return {q[0] / q[2], q[1] / q[2]};
}

class FieldFinder {
 public:
  FieldFinder(const cv::Mat& picture, const FieldParameters& field, const TagMetric& metric)
      : field_(field), size_(picture.size()), metric_(metric), lines_(field_lines(field)) {
    cv::Mat gray;
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
    mm_per_px_ = std::sqrt(metric.pixel_mm2());
    ridges_ = make_ridge_map(gray, static_cast<int>(std::ceil(kWidestLineMm / mm_per_px_)));
    for (const ModelLine& line : lines_) total_weight_ += line.weight;
    // Support is looked up, not searched: distance of every pixel to the nearest ridge.
    for (const Direction direction : {Direction::kUpright, Direction::kLevel}) {
      cv::Mat crest = ridges_.of(direction) < kMinContrast;
      cv::distanceTransform(crest, distance_[static_cast<std::size_t>(direction)], cv::DIST_L2, 3);
    }
    field_.corners_px.clear();
    field_.lens_k1 = field_.lens_k2 = 0.0;
    field_.image_size_px = size_;
    field_.half_time = false;
  }

  std::optional<FoundField> find() {
    const std::optional<Corners> start = best_hypothesis();
    if (!start) return std::nullopt;
    Estimate straight{*start, 0.0};
    refine(straight, false);
    Estimate bent = straight;
    refine(bent, true);
    const bool lens_helps =
        error_px(bent) <= kMinLensGain * error_px(straight) && bulge_px(bent) >= kMinBulgePx;
    const Estimate& chosen = lens_helps ? bent : straight;
    FoundField found;
    found.corners_px = chosen.corners;
    found.lens_k1 = chosen.k1;
    found.error_px = error_px(chosen);
    if (found.error_px > kMostlyChance * error_reach_px()) return std::nullopt;
    const Field field = to_field(chosen);
    for (const ModelLine& line : lines_) {
      const double share = share_seen(
          line, [&](cv::Point2d p) { return field.to_image_px(p, 0.0); }, kCaptureMm / 2.0);
      if (share < kLineSeen) continue;
      found.lines.emplace_back(line.name);
      found.seen_share += share * line.weight / total_weight_;
    }
    if (found.seen_share < kMinSeenShare) return std::nullopt;
    return found;
  }

 private:
  static constexpr double kMinBulgePx = 0.7;

  struct Estimate {
    Corners corners;
    double k1 = 0.0;
  };

  Field to_field(const Estimate& estimate) const {
    FieldParameters parameters = field_;
    parameters.corners_px.assign(estimate.corners.begin(), estimate.corners.end());
    parameters.lens_k1 = estimate.k1;
    return Field(parameters, size_);
  }

  /// @return false when the fit runs away to corners that are no field.
  bool try_to_bend(Estimate& estimate) const {
    try {
      refine(estimate, true);
      error_px(estimate);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }

  /// How far the lens bends the field's longer side.
  double bulge_px(const Estimate& estimate) const {
    const Field field = to_field(estimate);
    const double x = field_.length_mm / 2.0;
    const double y = field_.width_mm / 2.0;
    const cv::Point2d straight =
        (field.to_image_px({-x, y}, 0.0) + field.to_image_px({x, y}, 0.0)) * 0.5;
    return cv::norm(field.to_image_px({0, y}, 0.0) - straight);
  }

  std::optional<Corners> best_hypothesis() const {
    const double min_length_px = kShortestLineMm / mm_per_px_ / kMaxScaleRatio;
    const auto upright = find_lines(ridges_, Direction::kUpright, kMinContrast, min_length_px);
    const auto level = find_lines(ridges_, Direction::kLevel, kMinContrast, min_length_px);
    const std::vector<Span> across =
        spans_of(upright, line_places_mm(field_, Direction::kUpright), metric_.mm_per_px()(0, 0));
    const std::vector<Span> down =
        spans_of(level, line_places_mm(field_, Direction::kLevel), metric_.mm_per_px()(1, 1));
    std::optional<Corners> best;
    double best_support = 0.0;
    for (const Span& x : across) {
      for (const Span& y : down) {
        const double stretch = x.scale_ratio / y.scale_ratio;
        if (stretch > kMaxStretchRatio || stretch < 1.0 / kMaxStretchRatio) continue;
        const cv::Matx33d h = homography(x, y);
        const double support = support_of([&](cv::Point2d p) { return through(h, p); });
        if (support <= best_support) continue;
        best_support = support;
        best = corners_of(h);
      }
    }
    return best;
  }

  /// Two seen lines read as two of the model.
  struct Span {
    SeenLine first, second;  ///< In the order of the places.
    double first_mm = 0.0;
    double second_mm = 0.0;
    double scale_ratio = 1.0;  ///< To the scale of the tags.
  };

  /// @param mm_per_px of this axis, by the tags.
  static std::vector<Span> spans_of(const std::vector<SeenLine>& lines,
                                    const std::vector<double>& places_mm, double mm_per_px) {
    std::vector<Span> spans;
    for (const SeenLine& a : lines) {
      for (const SeenLine& b : lines) {
        if (b.position_px <= a.position_px) continue;
        for (std::size_t i = 0; i < places_mm.size(); ++i) {
          for (std::size_t j = i + 1; j < places_mm.size(); ++j) {
            const double ratio =
                (places_mm[j] - places_mm[i]) / (b.position_px - a.position_px) / mm_per_px;
            if (ratio < kMinScaleRatio || ratio > kMaxScaleRatio) continue;
            spans.push_back({a, b, places_mm[i], places_mm[j], ratio});
          }
        }
      }
    }
    return spans;
  }

  /// Floor to picture. The picture's y points down, the field's up; `y` spans are listed downwards,
  /// and the field is the same upside down.
  cv::Matx33d homography(const Span& x, const Span& y) const {
    const cv::Point2d middle((size_.width - 1) / 2.0, (size_.height - 1) / 2.0);
    const std::array<cv::Point2f, 4> floor{cv::Point2f(cv::Point2d(x.first_mm, -y.first_mm)),
                                           cv::Point2f(cv::Point2d(x.second_mm, -y.first_mm)),
                                           cv::Point2f(cv::Point2d(x.second_mm, -y.second_mm)),
                                           cv::Point2f(cv::Point2d(x.first_mm, -y.second_mm))};
    const std::array<cv::Point2f, 4> seen{cv::Point2f(meet(x.first, y.first, middle)),
                                          cv::Point2f(meet(x.second, y.first, middle)),
                                          cv::Point2f(meet(x.second, y.second, middle)),
                                          cv::Point2f(meet(x.first, y.second, middle))};
    return cv::getPerspectiveTransform(floor.data(), seen.data());
  }

  Corners corners_of(const cv::Matx33d& h) const {
    const double x = field_.length_mm / 2.0;
    const double y = field_.width_mm / 2.0;
    return {through(h, {-x, y}), through(h, {x, y}), through(h, {x, -y}), through(h, {-x, -y})};
  }

  template <class ToPicture>
  double support_of(ToPicture to_picture) const {
    double support = 0.0;
    for (const ModelLine& line : lines_) {
      support += line.weight * share_seen(line, to_picture, kCaptureMm);
    }
    return support;
  }

  /// Share of a line's points that lie on a ridge of their direction. What lies outside the picture
  /// is not seen.
  template <class ToPicture>
  double share_seen(const ModelLine& line, ToPicture to_picture, double capture_mm) const {
    const auto capture_px = static_cast<float>(std::max(1.5, capture_mm / mm_per_px_));
    int seen = 0;
    for (const ModelPoint& point : line.points) {
      const cv::Point2d p = to_picture(point.position_mm);
      const cv::Point pixel(cvRound(p.x), cvRound(p.y));
      if (!cv::Rect({}, size_).contains(pixel)) continue;
      const bool upright = std::abs(point.across.x) > std::abs(point.across.y);
      const cv::Mat& distance = distance_[upright ? 0 : 1];
      seen += distance.at<float>(pixel) <= capture_px ? 1 : 0;
    }
    return static_cast<double>(seen) / static_cast<double>(line.points.size());
  }

  /// How far along the direction across a line its crest is found; nothing within reach: no value.
  std::optional<double> offset_px(cv::Point2d at, cv::Point2d across, double reach_px,
                                  bool inner_edge) const {
    const bool upright = std::abs(across.x) > std::abs(across.y);
    const cv::Mat& ridge = upright ? ridges_.upright : ridges_.level;
    const int reach = static_cast<int>(std::ceil(reach_px));
    const auto pixel_at = [&](int step) {
      return cv::Point(cvRound(at.x + step * across.x), cvRound(at.y + step * across.y));
    };
    const auto height = [&](int step) {
      const cv::Point pixel = pixel_at(step);
      return cv::Rect({}, size_).contains(pixel) ? static_cast<int>(ridge.at<std::uint8_t>(pixel))
                                                 : 0;
    };
    // Where a step's pixel really lies, which rounding has moved.
    const auto place = [&](int step) { return (cv::Point2d(pixel_at(step)) - at).dot(across); };
    int best = 0;
    for (int step = -reach; step <= reach; ++step) {
      if (height(step) > height(best) ||
          (height(step) == height(best) && std::abs(step) < std::abs(best))) {
        best = step;
      }
    }
    const int highest = height(best);
    if (highest < kMinContrast) return std::nullopt;
    int last = best;
    while (last < best + reach && height(last + 1) * 2 >= highest) ++last;
    int first = best;
    while (first > best - reach && height(first - 1) * 2 >= highest) --first;
    if (inner_edge && first == best - reach) return std::nullopt;  // no edge: a bright area
    if (inner_edge && (last - first + 1) * mm_per_px_ >= kThinnestWallMm) {
      // Half-way down the slope towards the field.
      const double beyond = height(first - 1);
      const double here = height(first);
      const double share = (here - highest / 2.0) / std::max(here - beyond, 1.0);
      return place(first) - share * (place(first) - place(first - 1));
    }
    // The middle of the whole crest, foot included, not of its brightest pixel.
    double weight = 0.0;
    double moment = 0.0;
    for (int step = first - 1; step <= last + 1; ++step) {
      weight += height(step);
      moment += height(step) * place(step);
    }
    return moment / weight;
  }

  struct Residual {
    cv::Point2d position_mm;
    cv::Point2d normal;  ///< In the picture.
    cv::Point2d target_px;
    double weight = 1.0;
  };

  /// Lines of which at least a part is where they are looked for.
  std::vector<Residual> residuals(const Estimate& estimate, double reach_px) const {
    const Field field = to_field(estimate);
    std::vector<Residual> all;
    for (const ModelLine& line : lines_) {
      std::vector<Residual> of_line;
      for (const ModelPoint& point : line.points) {
        const cv::Point2d at = field.to_image_px(point.position_mm, 0.0);
        const cv::Point2d beside = field.to_image_px(point.position_mm + point.across, 0.0);
        const double length = cv::norm(beside - at);
        if (length <= 0.0) continue;
        const cv::Point2d across = (beside - at) / length;
        if (const auto offset = offset_px(at, across, reach_px, line.is_outline)) {
          of_line.push_back({point.position_mm, across, at + *offset * across});
        }
      }
      if (2 * of_line.size() < line.points.size()) continue;
      all.insert(all.end(), of_line.begin(), of_line.end());
    }
    return all;
  }

  static std::array<double*, 9> unknowns(Estimate& estimate) {
    Corners& c = estimate.corners;
    return {&c[0].x, &c[0].y, &c[1].x, &c[1].y, &c[2].x, &c[2].y, &c[3].x, &c[3].y, &estimate.k1};
  }

  double distance_px(const Field& field, const Residual& r) const {
    return (r.target_px - field.to_image_px(r.position_mm, 0.0)).dot(r.normal);
  }

  /// Gauss–Newton with a robust weight; each round looks for the lines again, from nearer by.
  void refine(Estimate& estimate, bool with_lens) const {
    const int unknown_count = with_lens ? 9 : 8;
    for (const double reach_mm : {24.0, 16.0, 12.0, 10.0, 8.0, 8.0}) {
      const double reach_px = std::max(2.5, reach_mm / mm_per_px_);
      const std::vector<Residual> lines = residuals(estimate, reach_px);
      if (static_cast<int>(lines.size()) < 3 * unknown_count) return;
      const Field field = to_field(estimate);
      std::vector<Field> moved;
      std::array<double, 9> steps{};
      Estimate trial = estimate;
      for (int k = 0; k < unknown_count; ++k) {
        steps[static_cast<std::size_t>(k)] = k == 8 ? 1e-3 : 0.25;
        double& value = *unknowns(trial)[static_cast<std::size_t>(k)];
        const double before = value;
        value += steps[static_cast<std::size_t>(k)];
        moved.push_back(to_field(trial));
        value = before;
      }
      cv::Mat normal = cv::Mat::zeros(unknown_count, unknown_count, CV_64F);
      cv::Mat right = cv::Mat::zeros(unknown_count, 1, CV_64F);
      std::vector<double> row(static_cast<std::size_t>(unknown_count));
      for (const Residual& line : lines) {
        const double off = distance_px(field, line);
        const double weight = 1.0 / (1.0 + off * off / 2.0);
        for (int k = 0; k < unknown_count; ++k) {
          const auto i = static_cast<std::size_t>(k);
          row[i] = (off - distance_px(moved[i], line)) / steps[i];
        }
        for (int i = 0; i < unknown_count; ++i) {
          for (int j = 0; j < unknown_count; ++j) {
            normal.at<double>(i, j) +=
                weight * row[static_cast<std::size_t>(i)] * row[static_cast<std::size_t>(j)];
          }
          right.at<double>(i) += weight * row[static_cast<std::size_t>(i)] * off;
        }
      }
      // Where nothing was seen of a side its corners stay, rather than run away.
      for (int i = 0; i < unknown_count; ++i) normal.at<double>(i, i) += i == 8 ? 1.0 : 0.02;
      cv::Mat change;
      if (!cv::solve(normal, right, change, cv::DECOMP_CHOLESKY)) return;
      for (int k = 0; k < unknown_count; ++k) {
        *unknowns(estimate)[static_cast<std::size_t>(k)] += change.at<double>(k);
      }
    }
  }

  /// How far from its place a line is looked for when the fit is judged.
  double error_reach_px() const { return std::max(3.0, 10.0 / mm_per_px_); }

  double error_px(const Estimate& estimate) const {
    const Field field = to_field(estimate);
    const std::vector<Residual> lines = residuals(estimate, error_reach_px());
    double squares = 0.0;
    for (const Residual& line : lines) squares += std::pow(distance_px(field, line), 2);
    return lines.empty() ? 1e9 : std::sqrt(squares / static_cast<double>(lines.size()));
  }

  FieldParameters field_;
  cv::Size size_;
  TagMetric metric_;
  std::vector<ModelLine> lines_;
  double total_weight_ = 0.0;
  double mm_per_px_ = 1.0;
  RidgeMap ridges_;
  std::array<cv::Mat, 2> distance_;  ///< By direction.
};

}  // namespace

std::optional<FoundField> find_field(const cv::Mat& picture, const FieldParameters& field,
                                     const TagMetric& metric) {
  try {
    return FieldFinder(picture, field, metric).find();
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // corners that are no field: what was seen is none
  }
}

}  // namespace maggic::calibration
