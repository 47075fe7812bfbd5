#include "maggic/truth.hpp"

namespace maggic {

std::string name_of(const TrueIdentity& identity, const Palette& palette) {
  std::string name(name_of(identity.team));
  if (identity.id) return name + ' ' + std::to_string(*identity.id);
  for (std::size_t i = 0; i < identity.player_colors.size(); ++i) {
    name += i == 0 ? ' ' : '+';
    name += palette.name(identity.player_colors[i]);
  }
  return name;
}

TrueScene scene_of(const Detections& detections) {
  TrueScene scene;
  for (const RobotDetection& robot : detections.robots) {
    if (robot.state != TrackState::kSeen) continue;
    TrueRobot& real = scene.robots.emplace_back();
    real.identity.team = robot.team;
    if (robot.id != kUnknownId) real.identity.id = robot.id;
    real.identity.player_colors = robot.player_colors;
    real.centroid_px = robot.centroid_px;
    real.position_mm = robot.position_mm;
    real.heading_rad = robot.heading_rad;
  }
  if (detections.ball && detections.ball->state == TrackState::kSeen) {
    scene.ball = TrueBall{detections.ball->centroid_px, detections.ball->position_mm};
  }
  return scene;
}

}  // namespace maggic
