#include "network/persistent_sender.hpp"

#include <optional>

#include <fmt/format.h>

namespace maggic::network {

bool PersistentSender::send(std::string_view packet, Moment now) {
  if (!trouble_.empty() && now < next_attempt_) return false;
  if (!is_open_) {
    if (const std::optional<std::string> why = socket_->open()) {
      note_trouble(*why, now);
      return false;
    }
    is_open_ = true;
  }
  const std::optional<Refusal> refusal = socket_->send(packet);
  if (!refusal) {
    note_success(now);
    return true;
  }
  if (refusal->passing) {
    reporter_.warn(fmt::format("a packet was left out, {}", refusal->reason));
    return false;
  }
  // What is wrong may be the socket itself, bound to an interface that is gone.
  socket_->close();
  is_open_ = false;
  note_trouble(refusal->reason, now);
  return false;
}

void PersistentSender::note_trouble(const std::string& reason, Moment now) {
  next_attempt_ = now + kRetryAfter;
  if (trouble_ == reason) return;
  if (trouble_.empty()) trouble_since_ = now;
  trouble_ = reason;
  reporter_.warn(fmt::format("nothing is sent, {}; trying again every second", reason));
}

void PersistentSender::note_success(Moment now) {
  if (trouble_.empty()) return;
  trouble_.clear();
  const std::chrono::duration<double> away = now - trouble_since_;
  reporter_.warn(fmt::format("packets are sent again after {:.1f} s", away.count()));
}

}  // namespace maggic::network
