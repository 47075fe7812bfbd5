#pragma once
/// Something packets can be put into without ever waiting.

#include <optional>
#include <string>
#include <string_view>

namespace maggic::network {

/// Why a packet was not taken.
struct Refusal {
  std::string reason;
  bool passing = false;  ///< Only too many at once: the next one may well be taken.
};

/// One thread at a time calls it; no call waits.
class PacketSocket {
 public:
  virtual ~PacketSocket() = default;
  /// Makes it ready to send. @return nothing when that worked, else why not.
  virtual std::optional<std::string> open() = 0;
  /// Sends one packet or leaves it. @return nothing when it was taken, else why not.
  virtual std::optional<Refusal> send(std::string_view packet) = 0;
  /// Lets go of the network; `open` may follow.
  virtual void close() = 0;
};

}  // namespace maggic::network
