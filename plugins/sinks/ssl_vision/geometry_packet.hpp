#pragma once
/// The field as SSL_WrapperPacket.

#include <string>

#include "maggic/field.hpp"
#include "network/field_markings.hpp"

namespace maggic::ssl_vision {

/// The encoded packet, no larger than kMaxPacketBytes: sizes in whole millimetres, lines and centre
/// circle under the names ssl-vision gives them. The walls stand on the outer lines, so the
/// boundary's width is 0. No camera calibration: a homography from field corners does not hold the
/// camera's rotation and lens that one would have to name.
std::string geometry_packet(const FieldParameters& field, const network::FieldMarkings& markings);

}  // namespace maggic::ssl_vision
