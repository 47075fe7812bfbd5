#include "tracking/pose.hpp"

#include <cmath>

namespace maggic::tracking {

Placement::Placement(const Pose& pose)
    : pose_(pose), cos_(std::cos(pose.heading_rad)), sin_(std::sin(pose.heading_rad)) {}

cv::Point2d Pose::apply(cv::Point2d robot_mm) const { return Placement(*this).apply(robot_mm); }

cv::Point2d Pose::to_robot(cv::Point2d field_mm) const {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  const cv::Point2d d = field_mm - position_mm;
  return {c * d.x + s * d.y, -s * d.x + c * d.y};
}

Placement fit_placement(std::span<const PointPair> pairs) {
  cv::Point2d robot_mean;
  cv::Point2d field_mean;
  double weight = 0.0;
  for (const PointPair& pair : pairs) {
    robot_mean += pair.weight * pair.robot_mm;
    field_mean += pair.weight * pair.field_mm;
    weight += pair.weight;
  }
  robot_mean /= weight;
  field_mean /= weight;
  // In the plane Kabsch's singular value decomposition comes down to one atan2.
  double cross = 0.0;
  double dot = 0.0;
  for (const PointPair& pair : pairs) {
    const cv::Point2d r = pair.robot_mm - robot_mean;
    const cv::Point2d f = pair.field_mm - field_mean;
    cross += pair.weight * r.cross(f);
    dot += pair.weight * r.dot(f);
  }
  Placement placement({{}, std::atan2(cross, dot)});
  placement.move_to(field_mean - placement.apply(robot_mean));
  return placement;
}

}  // namespace maggic::tracking
