#pragma once
/// Radial lens distortion, made invertible everywhere.

#include <limits>

namespace maggic {

/// Brown–Conrady with two radial terms, in OpenCV's convention and in units of the focal length:
/// r_distorted = r · (1 + k1·r² + k2·r⁴).
///
/// With a negative term the polynomial turns back at some distance, where no lens does. From the
/// distance at which its slope has fallen to `kMinSlope` it is continued by its tangent, so that
/// both directions are defined, finite and each other's inverse for every distance.
class RadialLens {
 public:
  static constexpr double kMinSlope = 0.05;

  RadialLens() = default;
  RadialLens(double k1, double k2);

  /// @param radius of the ideal ray, at least 0. @return where the lens puts it.
  double distort(double radius) const;
  /// Inverse of `distort`, to 1e-12 relative.
  double undistort(double distorted_radius) const;
  /// Derivative of `distort`, at least `kMinSlope`.
  double slope(double radius) const;

 private:
  double polynomial(double radius) const;

  double k1_ = 0.0;
  double k2_ = 0.0;
  double limit_ = std::numeric_limits<double>::infinity();  ///< The tangent is used from here.
  double limit_value_ = 0.0;
};

}  // namespace maggic
