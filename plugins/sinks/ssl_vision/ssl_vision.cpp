/// ssl_vision: robots, ball and field as ssl-vision sends them, for clients of the small size
/// league and of very small size soccer that speak its protocol.
///
///     sinks:
///       - ssl_vision:
///           address: 224.5.23.2     # of a multicast group, or of one machine
///           port: 10015             # ssl-vision itself uses 10006
///           interface: ""           # name or address of a network card; empty: as routed
///           ttl: 1                  # networks a multicast packet may pass
///           loopback: true          # whether programs on this machine hear multicast packets
///           camera_id: 0            # for clients that merge several cameras
///           unknown_ids: false      # true: robots without an id too, with robot_id left out
///           markings: {goal_width_mm: 400}
///
/// Every frame is an SSL_WrapperPacket with an SSL_DetectionFrame: millimetres and radians, origin
/// at the centre, pixels of the picture as it was taken. What was not seen in the frame itself is
/// left out; `ssl_tracked` sends predictions. Many clients take a robot without an id for number 0,
/// which is why such robots are left out at first. A packet stays below 1024 bytes; robots beyond
/// that follow in further packets of the same frame_number. The field comes in a packet of its own
/// with the first frame and then once a second of capture time.
///
/// t_capture and t_sent are in Unix time for live sources. For recorded ones t_capture counts from
/// the first frame, and t_sent is later by the time the frame took to be worked on.
///
/// Without a network packets are left out, with one warning, and tried again every second.

#include <chrono>
#include <memory>
#include <optional>

#include "detection_packets.hpp"
#include "geometry_packet.hpp"
#include "live/capture_clock.hpp"
#include "maggic/plugin.hpp"
#include "network/persistent_sender.hpp"
#include "network/udp_settings.hpp"
#include "network/udp_socket.hpp"
#include "once_a_second.hpp"

namespace {

using maggic::ssl_vision::PacketContext;

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

class SslVision final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    udp_.describe(p);
    p.integer({"camera_id", "the camera's number, for clients that merge several"}, camera_id_,
              {0, 255});
    p.boolean({"unknown_ids", "whether robots without an id are sent, with robot_id left out"},
              unknown_ids_);
    markings_.describe(p);
  }

  void prepare(const maggic::StageContext& context) override {
    sender_.emplace(std::make_unique<maggic::network::UdpSocket>(udp_), context.reporter);
  }

  void open(const maggic::RunInfo& info) override { live_ = info.source.live; }

  void write(const maggic::FrameResult& result, const maggic::Field& field) override {
    const maggic::Detections& found = result.detections;
    if (geometry_.is_due(found.captured) &&
        sender_->send(maggic::ssl_vision::geometry_packet(field.parameters(), markings_))) {
      geometry_.note_done(found.captured);
    }
    PacketContext context;
    context.t_sent_s = seconds(live_ ? clock_.now() : found.captured + result.times.frame_path());
    context.camera_id = static_cast<std::uint32_t>(camera_id_);
    context.robot_height_mm = field.robot_height_mm();
    context.unknown_ids = unknown_ids_;
    for (const std::string& packet : maggic::ssl_vision::detection_packets(found, context)) {
      sender_->send(packet);
    }
  }

 private:
  maggic::network::UdpSettings udp_{.address = "224.5.23.2", .port = 10015};
  int camera_id_ = 0;
  bool unknown_ids_ = false;
  maggic::network::FieldMarkings markings_;

  std::optional<maggic::network::PersistentSender> sender_;
  maggic::live::CaptureClock clock_;
  bool live_ = false;
  maggic::ssl_vision::OnceASecond geometry_;
};

}  // namespace

MAGGIC_PLUGIN(SslVision, "sends robots, ball and field over the network as ssl-vision does")
