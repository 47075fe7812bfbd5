#include "studio/server/picture_stream.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace maggic::studio {

using std::chrono::steady_clock;

PictureStream::PictureStream(Session& session, std::string view, int width_px, const StopFlag& stop)
    : session_(session), view_(std::move(view)), width_px_(width_px), stop_(stop) {}

bool PictureStream::send_next(httplib::DataSink& sink) {
  constexpr std::chrono::microseconds kInterval(33'333);
  // So short that a server that stops need not wait for it.
  constexpr std::chrono::milliseconds kPatience(100);
  // Only then is a picture taken, so that it is the newest.
  if (!sink.is_writable() || stop_.wait_until(next_at_)) return false;
  const std::shared_ptr<const Picture> picture =
      session_.next_picture(view_, width_px_, last_, kPatience);
  if (!picture) return true;

  part_.clear();
  if (last_ == 0) part_ += "--frame\r\n";
  fmt::format_to(std::back_inserter(part_),
                 "Content-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n", picture->jpeg.size());
  part_.append(reinterpret_cast<const char*>(picture->jpeg.data()), picture->jpeg.size());
  // Browsers show a picture once the line that ends it is there.
  part_ += "\r\n--frame\r\n";
  last_ = picture->sequence;
  // Held against the clock, not against the last picture: the mean is what is promised.
  next_at_ = std::max(next_at_ + kInterval, steady_clock::now());
  return sink.write(part_.data(), part_.size());
}

}  // namespace maggic::studio
