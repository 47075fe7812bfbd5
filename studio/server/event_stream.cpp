#include "studio/server/event_stream.hpp"

#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace maggic::studio {

using std::chrono::steady_clock;

std::string wire_text(const Event& event) {
  std::string text = fmt::format("id: {}\nevent: {}\n", event.number, event.name);
  std::string_view left = event.data;
  for (;;) {
    const auto end = left.find('\n');
    text += fmt::format("data: {}\n", left.substr(0, end));
    if (end == left.npos) break;
    left.remove_prefix(end + 1);
  }
  return text += '\n';
}

EventStream::EventStream(Session& session, std::uint64_t after, const StopFlag& stop)
    : session_(session), last_(after), stop_(stop), silent_since_(steady_clock::now()) {}

bool EventStream::send_next(httplib::DataSink& sink) {
  constexpr std::chrono::seconds kLongestSilence(5);
  // So short that a server that stops need not wait for it.
  constexpr std::chrono::milliseconds kPatience(100);
  if (!sink.is_writable() || stop_.raised()) return false;

  std::string text;
  if (!begun_) text = "retry: 1000\n\n";  // Milliseconds until a browser that was cut off is back.
  begun_ = true;
  if (text.empty()) {
    if (const std::optional<Event> event = session_.next_event(last_, kPatience)) {
      last_ = event->number;
      text = wire_text(*event);
    } else if (steady_clock::now() - silent_since_ > kLongestSilence) {
      text = ":\n\n";
    } else {
      return true;
    }
  }
  silent_since_ = steady_clock::now();
  return sink.write(text.data(), text.size());
}

}  // namespace maggic::studio
