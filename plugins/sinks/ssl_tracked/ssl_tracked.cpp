/// ssl_tracked: robots and ball with their velocities, predictions included, as trackers of the
/// small size league send them.
///
///     sinks:
///       - ssl_tracked:
///           address: 224.5.23.2     # of a multicast group, or of one machine
///           port: 10010
///           interface: ""           # name or address of a network card; empty: as routed
///           ttl: 1                  # networks a multicast packet may pass
///           loopback: true          # whether programs on this machine hear multicast packets
///           source_name: maggic     # what clients show
///
/// Every frame is a TrackerWrapperPacket: metres, radians and seconds, origin at the centre.
/// `visibility` is the detection's confidence, which falls while an object is only predicted. The
/// packet names robots by id, so robots whose id is not known are left out. `uuid` is drawn anew
/// for every run. `timestamp` is the capture time: Unix time for live sources, counted from the
/// first frame for recorded ones.
///
/// Without a network packets are left out, with one warning, and tried again every second.

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "maggic/plugin.hpp"
#include "network/persistent_sender.hpp"
#include "network/udp_settings.hpp"
#include "network/udp_socket.hpp"
#include "random_uuid.hpp"
#include "ssl_tracked.pb.h"

namespace {

using maggic::BallDetection;
using maggic::RobotDetection;

float metres(double length_mm) { return static_cast<float>(length_mm / 1000.0); }

template <class Vector>
void set_xy(Vector& out, cv::Point2d vector_mm) {
  out.set_x(metres(vector_mm.x));
  out.set_y(metres(vector_mm.y));
}

void fill(TrackedBall& out, const BallDetection& ball) {
  set_xy(*out.mutable_pos(), ball.position_mm);
  out.mutable_pos()->set_z(0.0F);  // it lies on the floor as far as one camera can tell
  set_xy(*out.mutable_vel(), ball.velocity_mm_s);
  out.mutable_vel()->set_z(0.0F);
  out.set_visibility(static_cast<float>(ball.confidence));
}

void fill(TrackedRobot& out, const RobotDetection& robot) {
  out.mutable_robot_id()->set_id(static_cast<std::uint32_t>(robot.id));
  out.mutable_robot_id()->set_team_color(robot.team == maggic::Team::kYellow ? TEAM_COLOR_YELLOW
                                                                             : TEAM_COLOR_BLUE);
  set_xy(*out.mutable_pos(), robot.position_mm);
  out.set_orientation(static_cast<float>(robot.heading_rad));
  set_xy(*out.mutable_vel(), robot.velocity_mm_s);
  out.set_vel_angular(static_cast<float>(robot.angular_velocity_rad_s));
  out.set_visibility(static_cast<float>(robot.confidence));
}

class SslTracked final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    udp_.describe(p);
    p.text({"source_name", "name of the source that clients show"}, source_name_);
  }

  void prepare(const maggic::StageContext& context) override {
    uuid_ = maggic::ssl_tracked::random_uuid();
    sender_.emplace(std::make_unique<maggic::network::UdpSocket>(udp_), context.reporter);
  }

  void open(const maggic::RunInfo& /*info*/) override {}

  void write(const maggic::FrameResult& result, const maggic::Field& /*field*/) override {
    const maggic::Detections& found = result.detections;
    TrackerWrapperPacket packet;
    packet.set_uuid(uuid_);
    packet.set_source_name(source_name_);
    TrackedFrame& frame = *packet.mutable_tracked_frame();
    frame.set_frame_number(static_cast<std::uint32_t>(found.sequence));
    frame.set_timestamp(std::chrono::duration<double>(found.captured).count());
    if (found.ball) fill(*frame.add_balls(), *found.ball);
    for (const RobotDetection& robot : found.robots) {
      if (robot.id != maggic::kUnknownId) fill(*frame.add_robots(), robot);
    }
    sender_->send(packet.SerializeAsString());
  }

 private:
  maggic::network::UdpSettings udp_{.address = "224.5.23.2", .port = 10010};
  std::string source_name_ = "maggic";

  std::string uuid_;
  std::optional<maggic::network::PersistentSender> sender_;
};

}  // namespace

MAGGIC_PLUGIN(SslTracked, "sends tracked robots and ball, predictions included, over the network")
