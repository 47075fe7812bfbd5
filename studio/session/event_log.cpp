#include "studio/session/event_log.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

namespace maggic::studio {

void EventLog::add(std::string name, std::string data) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back({++last_number_, std::move(name), std::move(data)});
    if (events_.size() > kKept) events_.pop_front();
  }
  added_.notify_all();
}

void EventLog::tell(std::string_view level, std::string_view text) {
  const nlohmann::json message{{"level", level}, {"text", text}};
  add("message", message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::optional<Event> EventLog::next(std::uint64_t after, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  const bool is_new = after == 0 || after > last_number_;
  if (is_new) after = last_number_ > 0 ? last_number_ - 1 : 0;
  if (!added_.wait_for(lock, timeout, [&] { return last_number_ > after; })) return {};
  const auto next = std::ranges::upper_bound(events_, after, {}, &Event::number);
  return *next;
}

}  // namespace maggic::studio
