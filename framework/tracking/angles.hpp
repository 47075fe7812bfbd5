#pragma once
/// Angles that wrap.

#include <cmath>
#include <numbers>

namespace maggic::tracking {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

/// The same direction in (-pi, pi].
inline double wrap_turn(double rad) {
  const double wrapped = std::remainder(rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// The same line (a direction without front and back) in [-pi/2, pi/2].
inline double wrap_line(double rad) { return std::remainder(rad, kPi); }

}  // namespace maggic::tracking
