#include "tracking/metric_blob.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/angles.hpp"

namespace maggic::tracking {
namespace {

constexpr double kMinSplitElongation = 1.3;

}  // namespace

double MetricBlob::elongation() const { return std::sqrt(major_mm2 / minor_mm2); }

double MetricBlob::fill() const {
  return area_mm2 / (4.0 * kPi * std::sqrt(major_mm2 * minor_mm2));
}

MetricBlob to_metric(const Blob& blob, int source, const Field& field, double height_mm) {
  MetricBlob metric;
  metric.source = source;
  metric.label = blob.label;
  metric.position_mm = field.to_field_mm(blob.centroid_px, height_mm);
  const cv::Matx22d j = field.jacobian_mm_per_px(blob.centroid_px, height_mm);
  metric.area_mm2 = blob.area_px * std::abs(j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0));
  const cv::Matx22d moments(blob.moment_xx_px2, blob.moment_xy_px2, blob.moment_xy_px2,
                            blob.moment_yy_px2);
  const cv::Matx22d m = j * moments * j.t();
  const double mean = (m(0, 0) + m(1, 1)) / 2.0;
  const double half = std::hypot((m(0, 0) - m(1, 1)) / 2.0, m(0, 1));
  // Rounding, or moments never filled in, must not lead to a division by zero.
  metric.minor_mm2 = std::max(mean - half, 1e-6);
  metric.major_mm2 = std::max(mean + half, metric.minor_mm2);
  metric.axis_rad = 0.5 * std::atan2(2.0 * m(0, 1), m(0, 0) - m(1, 1));
  return metric;
}

AreaSieve::AreaSieve(const Field& field, double height_mm, double min_mm2, double max_mm2) {
  // Scale varies smoothly over the picture; corners, edges and centre hold its extremes.
  const cv::Size size = field.frame_size_px();
  double least = 0.0;
  double most = 0.0;
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 3; ++ix) {
      const cv::Point2d point(0.5 * ix * (size.width - 1), 0.5 * iy * (size.height - 1));
      const double scale = field.mm2_per_px2(point, height_mm);
      least = ix + iy == 0 ? scale : std::min(least, scale);
      most = std::max(most, scale);
    }
  }
  constexpr double kSlack = 1.5;
  min_px = min_mm2 / (std::max(most, 1e-9) * kSlack);
  max_px = max_mm2 / std::max(least, 1e-9) * kSlack;
}

bool split_in_two(const MetricBlob& blob, double patch_variance_mm2, MetricBlob& first,
                  MetricBlob& second) {
  const double squared = blob.major_mm2 + blob.minor_mm2 - patch_variance_mm2;
  if (squared <= 0.0 || blob.elongation() < kMinSplitElongation) return false;
  const double distance = std::sqrt(squared);
  const cv::Point2d offset(distance * std::cos(blob.axis_rad), distance * std::sin(blob.axis_rad));
  first = blob;
  first.area_mm2 = blob.area_mm2 / 2.0;
  first.position_mm = blob.position_mm - offset;
  first.parts = 1;
  second = first;
  second.position_mm = blob.position_mm + offset;
  second.parts = 2;
  return true;
}

}  // namespace maggic::tracking
