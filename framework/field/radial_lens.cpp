#include "maggic/radial_lens.hpp"

#include <cmath>
#include <initializer_list>

namespace maggic {
namespace {

/// Smallest positive root of slope(q) = 1 + 3·k1·q + 5·k2·q² = kMinSlope in q = r²; infinite when
/// there is none.
double squared_limit(double k1, double k2) {
  const double a = 5.0 * k2;
  const double b = 3.0 * k1;
  const double c = 1.0 - RadialLens::kMinSlope;
  const double none = std::numeric_limits<double>::infinity();
  if (a == 0.0) return b < 0.0 ? -c / b : none;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return none;
  // The form without cancellation: c is positive, so the root nearest to zero is c over the
  // larger-magnitude half.
  const double half = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  double limit = none;
  for (const double root : {half / a, half == 0.0 ? none : c / half}) {
    if (root > 0.0 && root < limit) limit = root;
  }
  return limit;
}

}  // namespace

RadialLens::RadialLens(double k1, double k2)
    : k1_(k1), k2_(k2), limit_(std::sqrt(squared_limit(k1, k2))) {
  if (std::isfinite(limit_)) limit_value_ = polynomial(limit_);
}

double RadialLens::polynomial(double radius) const {
  const double q = radius * radius;
  return radius * (1.0 + q * (k1_ + q * k2_));
}

double RadialLens::distort(double radius) const {
  if (radius <= limit_) return polynomial(radius);
  return limit_value_ + kMinSlope * (radius - limit_);
}

double RadialLens::slope(double radius) const {
  if (radius > limit_) return kMinSlope;
  const double q = radius * radius;
  return 1.0 + q * (3.0 * k1_ + q * 5.0 * k2_);
}

double RadialLens::undistort(double distorted_radius) const {
  if (k1_ == 0.0 && k2_ == 0.0) return distorted_radius;
  if (std::isfinite(limit_) && distorted_radius >= limit_value_) {
    return limit_ + (distorted_radius - limit_value_) / kMinSlope;
  }
  // Newton, kept inside a bracket: the slope is at least kMinSlope, hence the upper end.
  double low = 0.0;
  double high = distorted_radius / kMinSlope;
  double radius = distorted_radius;
  constexpr int kMaxIterations = 100;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double error = distort(radius) - distorted_radius;
    if (std::abs(error) <= 1e-15 * distorted_radius) break;
    (error < 0.0 ? low : high) = radius;
    const double next = radius - error / slope(radius);
    const double bracketed = next > low && next < high ? next : 0.5 * (low + high);
    if (bracketed == radius) break;
    radius = bracketed;
  }
  return radius;
}

}  // namespace maggic
