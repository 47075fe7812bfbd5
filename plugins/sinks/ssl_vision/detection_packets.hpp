#pragma once
/// One frame's robots and ball as SSL_WrapperPacket.

#include <cstdint>
#include <string>
#include <vector>

#include "maggic/detections.hpp"

namespace maggic::ssl_vision {

/// What of a packet is not in the detections.
struct PacketContext {
  double t_sent_s = 0.0;
  std::uint32_t camera_id = 0;
  double robot_height_mm = 0.0;
  bool unknown_ids = false;  ///< Whether robots without an id are in, with `robot_id` left out.
};

/// The encoded packets of a frame, no larger than kMaxPacketBytes each: one, or as many as the
/// robots need. All bear the frame's number and times; the ball is in the first. What was not seen
/// in this frame is left out, so a frame in which nothing was seen is one packet without objects.
std::vector<std::string> detection_packets(const Detections& found, const PacketContext& context);

}  // namespace maggic::ssl_vision
