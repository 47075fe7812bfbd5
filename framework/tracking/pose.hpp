#pragma once
/// Place and direction of a robot, and the rigid fit that finds them.

#include <cmath>
#include <span>

#include <opencv2/core/types.hpp>

namespace maggic::tracking {

/// std::hypot guards against overflow that cannot occur here, at several times the cost.
inline double length_of(cv::Point2d v) { return std::sqrt(v.dot(v)); }

/// Where the pattern's origin is and where its x axis points, in the field frame.
struct Pose {
  cv::Point2d position_mm;
  double heading_rad = 0.0;

  /// Field position of a point of the robot frame.
  cv::Point2d apply(cv::Point2d robot_mm) const;
  /// The robot frame's view of a point of the field; inverse of `apply`.
  cv::Point2d to_robot(cv::Point2d field_mm) const;
};

/// One point of the pattern and where it was seen.
struct PointPair {
  cv::Point2d robot_mm;
  cv::Point2d field_mm;
  double weight = 1.0;
};

/// Least-squares rotation and translation (no scale, no mirror), in closed form.
/// @param pairs at least two with different `robot_mm`; weights above 0.
Pose fit_pose(std::span<const PointPair> pairs);

}  // namespace maggic::tracking
