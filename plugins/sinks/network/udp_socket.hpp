#pragma once
/// Packets as UDP datagrams over IPv4.

#include <utility>

#include "network/packet_socket.hpp"
#include "network/udp_settings.hpp"

namespace maggic::network {

class UdpSocket final : public PacketSocket {
 public:
  /// @param settings checked ones: the address is one.
  explicit UdpSocket(UdpSettings settings) : settings_(std::move(settings)) {}
  ~UdpSocket() override { close(); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// Looks the interface up anew, so one that was plugged in again is found.
  std::optional<std::string> open() override;
  /// A packet nobody listens to counts as sent: UDP cannot tell.
  std::optional<Refusal> send(std::string_view packet) override;
  void close() override;

 private:
  std::optional<std::string> set_options();

  const UdpSettings settings_;
  int descriptor_ = -1;
};

}  // namespace maggic::network
