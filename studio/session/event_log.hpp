#pragma once
/// The latest events of a session, for any number of listeners.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "studio/session/event.hpp"

namespace maggic::studio {

/// Safe from any thread.
class EventLog {
 public:
  void add(std::string name, std::string data);

  /// Adds a message for whoever looks at the page.
  /// @param level `error`, `warning` or `note`. @param text bytes that are not UTF-8 are replaced.
  void tell(std::string_view level, std::string_view text);

  /// See Session::next_event.
  std::optional<Event> next(std::uint64_t after, std::chrono::milliseconds timeout);

 private:
  /// A listener this far behind has missed nothing worth hearing.
  static constexpr std::size_t kKept = 64;

  std::mutex mutex_;
  std::condition_variable added_;
  std::deque<Event> events_;
  std::uint64_t last_number_ = 0;
};

}  // namespace maggic::studio
