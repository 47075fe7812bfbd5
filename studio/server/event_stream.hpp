#pragma once
/// What happens in a session, told as it happens.

#include <chrono>
#include <cstdint>

#include <httplib.h>

#include "studio/server/stop_flag.hpp"
#include "studio/session/session.hpp"

namespace maggic::studio {

/// Server-sent events. Their ids are the session's numbers, with which a browser that was cut off
/// goes on where it was.
class EventStream {
 public:
  static constexpr const char* kContentType = "text/event-stream";

  /// @param after as of Session::next_event(). @param session, stop outlive this.
  EventStream(Session& session, std::uint64_t after, const StopFlag& stop);

  /// Sends the next event, if one comes within a moment, and a sign of life now and then.
  /// @return false when the stream is over: the reader is gone or too slow, or the server stops.
  bool send_next(httplib::DataSink& sink);

 private:
  Session& session_;
  std::uint64_t last_;
  const StopFlag& stop_;
  bool begun_ = false;
  std::chrono::steady_clock::time_point silent_since_;
};

/// As it goes over the wire.
std::string wire_text(const Event& event);

}  // namespace maggic::studio
