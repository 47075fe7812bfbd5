#include "tracking/fit_score.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/angles.hpp"

namespace maggic::tracking {
namespace {

double capped_square(double deviation, double sigma, double cap) {
  const double normalized = deviation / sigma;
  return std::min(0.5 * normalized * normalized, cap);
}

}  // namespace

double outline_cost(const PatchModel& patch, const MetricBlob& blob) {
  const double area_cost = capped_square(std::log(blob.area_mm2 / patch.area_mm2), 0.35, 4.0);
  if (blob.is_half()) return area_cost;
  return area_cost + capped_square(std::log(blob.elongation() / patch.elongation), 0.25, 6.0);
}

double direction_cost(const PatchModel& patch, const MetricBlob& blob, double heading_rad) {
  if (blob.is_half() || !patch.is_elongated() || blob.elongation() <= 1.25) return 0.0;
  const double turned = wrap_line(blob.axis_rad - patch.axis_rad - heading_rad);
  return capped_square(turned, radians(15.0), 4.0);
}

double place_cost(double error_mm, double max_error_mm) {
  const double normalized = 3.0 * error_mm / max_error_mm;
  return 0.5 * normalized * normalized;
}

bool is_convincing_alone(const PatchModel& patch, const MetricBlob& blob) {
  const double area = blob.area_mm2 / patch.area_mm2;
  const double elongation = blob.elongation() / patch.elongation;
  return !blob.is_half() && area > 0.6 && area < 1.5 && elongation > 0.72 && elongation < 1.4 &&
         blob.fill() > 0.8;
}

}  // namespace maggic::tracking
