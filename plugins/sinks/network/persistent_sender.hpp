#pragma once
/// Sends packets while there is a network and tries again while there is none. Whoever has packets
/// never waits: those that cannot be sent are left out, because a late position is a wrong one.

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "maggic/stage.hpp"
#include "network/packet_socket.hpp"

namespace maggic::network {

class PersistentSender {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  /// The time from a failure to the next attempt, which is also the most warnings there can be.
  static constexpr std::chrono::seconds kRetryAfter{1};

  /// @param socket not open yet; opened by the first packet and again after every failure.
  /// @param reporter told when packets stop going out, when the reason changes, and when they go
  ///   out again; outlives this.
  PersistentSender(std::unique_ptr<PacketSocket> socket, Reporter& reporter)
      : socket_(std::move(socket)), reporter_(reporter) {}

  /// Sends a packet, or leaves it out while the next attempt is not due.
  /// @param now never earlier than at the call before.
  /// @return whether it was sent.
  bool send(std::string_view packet, Moment now = std::chrono::steady_clock::now());

 private:
  void note_trouble(const std::string& reason, Moment now);
  void note_success(Moment now);

  const std::unique_ptr<PacketSocket> socket_;
  Reporter& reporter_;
  bool is_open_ = false;
  std::string trouble_;  ///< Why nothing goes out, as last told; empty when all is well.
  Moment trouble_since_;
  Moment next_attempt_;
};

}  // namespace maggic::network
