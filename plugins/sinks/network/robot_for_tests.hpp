#pragma once
/// A robot that tests of network sinks send.

#include "maggic/detections.hpp"

namespace maggic::network {

inline RobotDetection robot(Team team, int id, TrackState state = TrackState::kSeen) {
  RobotDetection robot;
  robot.team = team;
  robot.id = id;
  robot.position_mm = {500.0, -250.0};
  robot.heading_rad = 0.5;
  robot.velocity_mm_s = {1000.0, -2000.0};
  robot.angular_velocity_rad_s = -3.0;
  robot.confidence = state == TrackState::kSeen ? 1.0 : 0.25;
  robot.state = state;
  return robot;
}

}  // namespace maggic::network
