#pragma once
/// How large a packet may be.

#include <cstddef>

namespace maggic::ssl_vision {

/// Clients in use read into a buffer of 1024 bytes, and some drop what fills it to the brim.
inline constexpr std::size_t kMaxPacketBytes = 1023;

}  // namespace maggic::ssl_vision
