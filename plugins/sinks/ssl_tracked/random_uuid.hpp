#pragma once
/// A name no other program has.

#include <cstdint>
#include <random>
#include <string>

#include <fmt/format.h>

namespace maggic::ssl_tracked {

/// A random UUID (RFC 4122, version 4), as 36 characters.
inline std::string random_uuid() {
  std::random_device device;
  std::uniform_int_distribution<std::uint64_t> bits;
  const std::uint64_t high = (bits(device) & ~0xF000ULL) | 0x4000ULL;
  const std::uint64_t low = (bits(device) & ~(3ULL << 62)) | (2ULL << 62);
  return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, (high >> 16) & 0xFFFF,
                     high & 0xFFFF, low >> 48, low & 0xFFFF'FFFF'FFFFULL);
}

}  // namespace maggic::ssl_tracked
