#include "calibration/tag_metric.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

namespace maggic::calibration {
namespace {

// What one known distance weighs against the wish for an isotropic picture: a stretch is believed
// once some robots point in different directions.
constexpr double kIsotropyWeight = 0.75;
constexpr double kIsotropyShare = 0.02;  // … and at least so much of all distances

double median_mm_per_px(std::span<const KnownDistance> distances) {
  std::vector<double> scales;
  for (const KnownDistance& d : distances) scales.push_back(d.distance_mm / cv::norm(d.offset_px));
  const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
  std::nth_element(scales.begin(), middle, scales.end());
  return *middle;
}

}  // namespace

TagMetric TagMetric::of_scale(double mm_per_px) {
  return {cv::Matx22d::eye() * (mm_per_px * mm_per_px)};
}

double TagMetric::length_mm(cv::Point2d offset_px) const {
  const cv::Vec2d offset(offset_px.x, offset_px.y);
  return std::sqrt(offset.dot(mm2_per_px2 * offset));
}

double TagMetric::pixel_mm2() const { return std::sqrt(cv::determinant(mm2_per_px2)); }

cv::Matx22d TagMetric::mm_per_px() const {
  return {std::sqrt(mm2_per_px2(0, 0)), 0.0, 0.0, std::sqrt(mm2_per_px2(1, 1))};
}

TagMetric fit_metric(std::span<const KnownDistance> distances) {
  const TagMetric isotropic = TagMetric::of_scale(median_mm_per_px(distances));
  const double scale2 = isotropic.mm2_per_px2(0, 0);
  // Unknowns: xx and yy of M / scale2. Each row is in units of the squared distance.
  const double weight =
      std::max(kIsotropyWeight, kIsotropyShare * static_cast<double>(distances.size()));
  cv::Matx22d normal = cv::Matx22d::eye() * weight;
  cv::Vec2d right(weight, weight);
  for (const KnownDistance& d : distances) {
    const double unit = scale2 / (d.distance_mm * d.distance_mm);
    const cv::Vec2d row(d.offset_px.x * d.offset_px.x * unit, d.offset_px.y * d.offset_px.y * unit);
    normal += row * row.t();
    right += row;
  }
  const cv::Vec2d solved = normal.inv() * right;
  const cv::Matx22d m(solved[0], 0.0, 0.0, solved[1]);
  constexpr double kMostStretched = 0.25;  // of the determinant an isotropic picture would have
  if (m(0, 0) <= 0.0 || m(1, 1) <= 0.0 || cv::determinant(m) < kMostStretched) return isotropic;
  return {m * scale2};
}

}  // namespace maggic::calibration
