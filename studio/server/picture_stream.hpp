#pragma once
/// A view as a moving picture.

#include <cstdint>
#include <string>

#include <httplib.h>

#include "studio/server/stop_flag.hpp"
#include "studio/session/session.hpp"

namespace maggic::studio {

/// Motion JPEG: one part of a `multipart/x-mixed-replace` a picture, the newest each time the
/// reader has room for one, and no more than 30 a second.
class PictureStream {
 public:
  static constexpr const char* kContentType = "multipart/x-mixed-replace; boundary=frame";

  /// @param view, width_px as of Session::next_picture(). @param session, stop outlive this.
  PictureStream(Session& session, std::string view, int width_px, const StopFlag& stop);

  /// Sends the next picture, if one comes within a moment.
  /// @return false when the stream is over: the reader is gone or too slow, or the server stops.
  bool send_next(httplib::DataSink& sink);

 private:
  Session& session_;
  const std::string view_;
  const int width_px_;
  const StopFlag& stop_;
  std::uint64_t last_ = 0;
  std::chrono::steady_clock::time_point next_at_ = std::chrono::steady_clock::now();
  std::string part_;  ///< Kept, so that its memory serves the next picture too.
};

}  // namespace maggic::studio
