#pragma once
/// Angles that wrap.

#include <cmath>
#include <numbers>

namespace maggic::tracking {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

/// std::remainder, at a fraction of its cost where the quotient is -1, 0 or 1; there subtracting is
/// exact as well.
inline double remainder_of(double rad, double period) {
  if (std::abs(rad) <= 0.5 * period) return rad;
  if (std::abs(rad) < 1.5 * period) return rad - std::copysign(period, rad);
  return std::remainder(rad, period);
}

/// The same direction in (-pi, pi].
inline double wrap_turn(double rad) {
  const double wrapped = remainder_of(rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// The same line (a direction without front and back) in [-pi/2, pi/2].
inline double wrap_line(double rad) { return remainder_of(rad, kPi); }

}  // namespace maggic::tracking
