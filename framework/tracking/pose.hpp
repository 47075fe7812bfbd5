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

/// A pose with its rotation worked out: places several points at the cost of one.
class Placement {
 public:
  explicit Placement(const Pose& pose);
  const Pose& pose() const { return pose_; }
  cv::Point2d apply(cv::Point2d robot_mm) const {
    return {pose_.position_mm.x + cos_ * robot_mm.x - sin_ * robot_mm.y,
            pose_.position_mm.y + sin_ * robot_mm.x + cos_ * robot_mm.y};
  }
  void move_to(cv::Point2d position_mm) { pose_.position_mm = position_mm; }

 private:
  Pose pose_;
  double cos_;
  double sin_;
};

/// One point of the pattern and where it was seen.
struct PointPair {
  cv::Point2d robot_mm;
  cv::Point2d field_mm;
  double weight = 1.0;
};

/// Least-squares rotation and translation (no scale, no mirror), in closed form.
/// @param pairs at least two with different `robot_mm`; weights above 0.
Placement fit_placement(std::span<const PointPair> pairs);
inline Pose fit_pose(std::span<const PointPair> pairs) { return fit_placement(pairs).pose(); }

}  // namespace maggic::tracking
