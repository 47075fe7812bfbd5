/// fira: robots, ball and field as the simulator FIRASim sends them, so that a team's program runs
/// on the real field as it does in simulation.
///
///     sinks:
///       - fira:
///           address: 224.0.0.1      # of a multicast group, or of one machine
///           port: 10002
///           interface: ""           # name or address of a network card; empty: as routed
///           ttl: 1                  # networks a multicast packet may pass
///           loopback: true          # whether programs on this machine hear multicast packets
///           markings: {goal_width_mm: 400}
///
/// Every frame is an Environment: metres, radians and seconds, origin at the centre. A simulator
/// knows where everything is at all times and its packets have no word for doubt, so robots and
/// ball that are only predicted are in like those seen. Robots whose id is not known are left out,
/// and so is the ball while there is none, which clients that do not ask for it read as one at the
/// centre. `step` is the frame's number.
///
/// Without a network packets are left out, with one warning, and tried again every second.

#include <memory>
#include <optional>

#include "fira.pb.h"
#include "maggic/plugin.hpp"
#include "network/field_markings.hpp"
#include "network/persistent_sender.hpp"
#include "network/udp_settings.hpp"
#include "network/udp_socket.hpp"

namespace {

using maggic::RobotDetection;

constexpr double metres(double length_mm) { return length_mm / 1000.0; }

void fill(fira_message::Ball& out, const maggic::BallDetection& ball, double height_mm) {
  out.set_x(metres(ball.position_mm.x));
  out.set_y(metres(ball.position_mm.y));
  out.set_z(metres(height_mm));
  out.set_vx(metres(ball.velocity_mm_s.x));
  out.set_vy(metres(ball.velocity_mm_s.y));
}

void fill(fira_message::Robot& out, const RobotDetection& robot) {
  out.set_robot_id(static_cast<std::uint32_t>(robot.id));
  out.set_x(metres(robot.position_mm.x));
  out.set_y(metres(robot.position_mm.y));
  out.set_orientation(robot.heading_rad);
  out.set_vx(metres(robot.velocity_mm_s.x));
  out.set_vy(metres(robot.velocity_mm_s.y));
  out.set_vorientation(robot.angular_velocity_rad_s);
}

void fill(fira_message::Field& out, const maggic::FieldParameters& field,
          const maggic::network::FieldMarkings& markings) {
  out.set_width(metres(field.width_mm));
  out.set_length(metres(field.length_mm));
  out.set_goal_width(metres(markings.goal_width_mm));
  out.set_goal_depth(metres(markings.goal_depth_mm));
  out.set_center_radius(metres(markings.center_circle_radius_mm));
  out.set_penalty_width(metres(markings.goal_area_width_mm));
  out.set_penalty_depth(metres(markings.goal_area_depth_mm));
}

class Fira final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    udp_.describe(p);
    markings_.describe(p);
  }

  void prepare(const maggic::StageContext& context) override {
    sender_.emplace(std::make_unique<maggic::network::UdpSocket>(udp_), context.reporter);
  }

  void open(const maggic::RunInfo& /*info*/) override {}

  void write(const maggic::FrameResult& result, const maggic::Field& field) override {
    const maggic::Detections& found = result.detections;
    fira_message::Environment packet;
    packet.set_step(static_cast<std::uint32_t>(found.sequence));
    fira_message::Frame& frame = *packet.mutable_frame();
    if (found.ball) fill(*frame.mutable_ball(), *found.ball, field.ball_height_mm());
    for (const RobotDetection& robot : found.robots) {
      if (robot.id == maggic::kUnknownId) continue;
      fill(robot.team == maggic::Team::kYellow ? *frame.add_robots_yellow()
                                               : *frame.add_robots_blue(),
           robot);
    }
    fill(*packet.mutable_field(), field.parameters(), markings_);
    sender_->send(packet.SerializeAsString());
  }

 private:
  maggic::network::UdpSettings udp_{.address = "224.0.0.1", .port = 10002};
  maggic::network::FieldMarkings markings_;

  std::optional<maggic::network::PersistentSender> sender_;
};

}  // namespace

MAGGIC_PLUGIN(Fira, "sends robots, ball and field over the network as FIRASim does")
