#include "detection_packets.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "packet_size.hpp"
#include "ssl_vision.pb.h"

namespace maggic::ssl_vision {
namespace {

std::uint32_t whole(double area_px) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(std::round(area_px), 0.0, kMost));
}

SSL_WrapperPacket empty_packet(const Detections& found, const PacketContext& context) {
  SSL_WrapperPacket packet;
  SSL_DetectionFrame& frame = *packet.mutable_detection();
  frame.set_frame_number(static_cast<std::uint32_t>(found.sequence));
  frame.set_t_capture(std::chrono::duration<double>(found.captured).count());
  frame.set_t_sent(context.t_sent_s);
  frame.set_camera_id(context.camera_id);
  return packet;
}

void fill(SSL_DetectionBall& out, const BallDetection& ball) {
  out.set_confidence(static_cast<float>(ball.confidence));
  out.set_area(whole(ball.area_px));
  out.set_x(static_cast<float>(ball.position_mm.x));
  out.set_y(static_cast<float>(ball.position_mm.y));
  out.set_z(0.0F);  // it lies on the floor as far as one camera can tell
  out.set_pixel_x(static_cast<float>(ball.centroid_px.x));
  out.set_pixel_y(static_cast<float>(ball.centroid_px.y));
}

void fill(SSL_DetectionRobot& out, const RobotDetection& robot, double height_mm) {
  out.set_confidence(static_cast<float>(robot.confidence));
  if (robot.id != kUnknownId) out.set_robot_id(static_cast<std::uint32_t>(robot.id));
  out.set_x(static_cast<float>(robot.position_mm.x));
  out.set_y(static_cast<float>(robot.position_mm.y));
  out.set_orientation(static_cast<float>(robot.heading_rad));
  out.set_pixel_x(static_cast<float>(robot.centroid_px.x));
  out.set_pixel_y(static_cast<float>(robot.centroid_px.y));
  out.set_height(static_cast<float>(height_mm));
}

auto& robots_of(SSL_WrapperPacket& packet, Team team) {
  SSL_DetectionFrame& frame = *packet.mutable_detection();
  return team == Team::kYellow ? *frame.mutable_robots_yellow() : *frame.mutable_robots_blue();
}

}  // namespace

std::vector<std::string> detection_packets(const Detections& found, const PacketContext& context) {
  std::vector<std::string> packets;
  SSL_WrapperPacket packet = empty_packet(found, context);
  if (found.ball && found.ball->state == TrackState::kSeen) {
    fill(*packet.mutable_detection()->add_balls(), *found.ball);
  }
  for (const RobotDetection& robot : found.robots) {
    if (robot.state != TrackState::kSeen) continue;
    if (robot.id == kUnknownId && !context.unknown_ids) continue;
    fill(*robots_of(packet, robot.team).Add(), robot, context.robot_height_mm);
    if (packet.ByteSizeLong() <= kMaxPacketBytes) continue;
    robots_of(packet, robot.team).RemoveLast();
    packets.push_back(packet.SerializeAsString());
    packet = empty_packet(found, context);
    fill(*robots_of(packet, robot.team).Add(), robot, context.robot_height_mm);
  }
  packets.push_back(packet.SerializeAsString());
  return packets;
}

}  // namespace maggic::ssl_vision
