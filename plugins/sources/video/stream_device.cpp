#include "stream_device.hpp"

#include <vector>

#include "video_clock.hpp"

namespace maggic::video {
namespace {

// FFmpeg's own patience is 30 s; the program's end waits for a call that blocks.
constexpr int kOpenTimeout_ms = 3000;
constexpr int kReadTimeout_ms = 3000;

}  // namespace

std::optional<std::string> StreamDevice::open() {
  const std::vector<int> timeouts = {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, kOpenTimeout_ms,
                                     cv::CAP_PROP_READ_TIMEOUT_MSEC, kReadTimeout_ms};
  if (!capture_.open(url_, cv::CAP_FFMPEG, timeouts)) {
    return "it cannot be opened (is the address right, does the sender run?)";
  }
  fps_ = plausible_rate(capture_.get(cv::CAP_PROP_FPS));
  return std::nullopt;
}

std::optional<std::string> StreamDevice::read(cv::Mat& picture, Timestamp& captured) {
  if (!capture_.grab()) return "it ended, or no picture came in time";
  captured = clock_.now();
  if (!capture_.retrieve(picture)) return "the picture could not be decoded";
  return std::nullopt;
}

}  // namespace maggic::video
