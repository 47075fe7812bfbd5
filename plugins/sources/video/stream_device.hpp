#pragma once
/// A network stream as a live device.

#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include <opencv2/videoio.hpp>

#include "live/capture_clock.hpp"
#include "live/reconnecting_device.hpp"

namespace maggic::video {

/// Frames are stamped as they arrive: what a stream says of its times counts from its own start.
class StreamDevice final : public live::FrameDevice {
 public:
  explicit StreamDevice(std::string url) : url_(std::move(url)) {}

  std::optional<std::string> open() override;
  std::optional<std::string> read(cv::Mat& picture, Timestamp& captured) override;
  void close() override { capture_.release(); }

  /// As the stream said when it was opened last; 0 when unknown.
  double fps() const { return fps_; }

 private:
  const std::string url_;
  const live::CaptureClock clock_;
  cv::VideoCapture capture_;
  std::atomic<double> fps_{0.0};
};

}  // namespace maggic::video
