#pragma once
/// Where packets go: the parameters every network sink has.

#include <cstdint>
#include <optional>
#include <string>

#include "maggic/parameters.hpp"

namespace maggic::network {

struct UdpSettings {
  std::string address;  ///< IPv4: of a multicast group, of one machine, or a broadcast address.
  int port = 0;         ///< 1 … 65535.
  /// Name of a network interface, or an IPv4 address it has; empty: as the system routes.
  std::string interface;
  int ttl = 1;           ///< Of multicast packets.
  bool loopback = true;  ///< Of multicast packets.

  /// The members as they are when it is called are the defaults.
  void describe(Parameters& parameters);
};

/// The 32 bits of an IPv4 address, the first of its four numbers highest.
/// @return nothing when `text` is not four numbers 0 … 255 with points between them.
std::optional<std::uint32_t> ipv4_from(const std::string& text);

}  // namespace maggic::network
