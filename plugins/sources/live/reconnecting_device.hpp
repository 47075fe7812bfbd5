#pragma once
/// Keeps a live device at hand: on a thread of its own it opens the device, reads it, and opens it
/// again with growing pauses when it is lost. Whoever wants frames never waits for any of that.
/// Knows nothing of OpenCV's video library, so it is tested with a device made of a few lines.

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <opencv2/core/mat.hpp>

#include "maggic/source.hpp"

namespace maggic::live {

/// Something that gives pictures as they are taken. One thread at a time calls it; calls may block
/// as long as they must, but the destruction of a ReconnectingDevice waits for them. A call may
/// throw, which counts as an answer why it failed.
class FrameDevice {
 public:
  virtual ~FrameDevice() = default;
  /// Opens and configures the device. @return nothing when that worked, else why not.
  virtual std::optional<std::string> open() = 0;
  /// Waits for the next picture and writes it into `picture`, reusing its memory where it fits.
  /// @return nothing when that worked, else why not; the device then counts as lost.
  virtual std::optional<std::string> read(cv::Mat& picture, Timestamp& captured) = 0;
  /// Lets go of the device; `open` may follow.
  virtual void close() = 0;
};

/// Pauses before the attempts to open a device: doubled from `first` to `longest`, and `first`
/// again once a picture came.
struct RetryPauses {
  std::chrono::milliseconds first{200};
  std::chrono::milliseconds longest{5000};
};

class ReconnectingDevice {
 public:
  /// @param name how warnings call the device, such as "camera 0".
  /// @param reporter told when the device is missing or lost, when the reason changes, and when it
  ///   is back; outlives this.
  ReconnectingDevice(std::unique_ptr<FrameDevice> device, std::string name, Reporter& reporter,
                     RetryPauses pauses = {});
  /// Ends the thread; waits for a device that blocks.
  ~ReconnectingDevice();
  ReconnectingDevice(const ReconnectingDevice&) = delete;
  ReconnectingDevice& operator=(const ReconnectingDevice&) = delete;

  /// Tries to open the device once, on this thread, and starts the other one. Called once.
  /// @param required whether the device must be there now.
  /// @throws std::runtime_error when it is required and not there.
  void start(bool required);

  /// The newest picture not yet given; `captured` never runs backwards. The memory of `frame.bgr`
  /// is exchanged rather than copied where nobody else holds it. kRetry after `patience`.
  ReadStatus read(Frame& frame, std::chrono::milliseconds patience);

 private:
  void work(bool is_open);
  bool pause(std::chrono::milliseconds duration);
  bool is_ending();
  bool deliver_until_lost();
  std::optional<std::string> try_open();
  std::optional<std::string> try_read(Timestamp& captured);
  void note_trouble(const std::string& what, const std::string& reason);
  void note_picture();

  const std::unique_ptr<FrameDevice> device_;
  const std::string name_;
  Reporter& reporter_;
  const RetryPauses pauses_;

  // Of the working thread (and of `start` before it).
  cv::Mat filling_;
  std::string trouble_;  ///< Why there is no picture, as last told; empty when all is well.
  std::chrono::steady_clock::time_point trouble_since_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable arrived_;
  std::condition_variable ending_;
  bool end_ = false;
  bool fresh_ = false;  ///< `ready_` was not given yet.
  cv::Mat ready_;
  Timestamp ready_captured_{0};
  Timestamp last_given_{0};

  std::thread thread_;
};

}  // namespace maggic::live
