#include "live/reconnecting_device.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace maggic::live {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// True when exchanging the buffer takes it from nobody: not lent memory, not shared, not a part.
bool is_held_alone(const cv::Mat& picture) {
  return picture.empty() ||
         (picture.u != nullptr && picture.u->refcount == 1 && !picture.isSubmatrix());
}

}  // namespace

ReconnectingDevice::ReconnectingDevice(std::unique_ptr<FrameDevice> device, std::string name,
                                       Reporter& reporter, RetryPauses pauses)
    : device_(std::move(device)), name_(std::move(name)), reporter_(reporter), pauses_(pauses) {}

ReconnectingDevice::~ReconnectingDevice() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ending_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ReconnectingDevice::start(bool required) {
  const std::optional<std::string> refusal = try_open();
  if (refusal) {
    if (required) throw std::runtime_error(fmt::format("{}: {}", name_, *refusal));
    note_trouble("is not there", *refusal);
  }
  thread_ = std::thread([this, is_open = !refusal] { work(is_open); });
}

ReadStatus ReconnectingDevice::read(Frame& frame, milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, patience, [this] { return fresh_; })) return ReadStatus::kRetry;
  fresh_ = false;
  if (is_held_alone(frame.bgr)) {
    std::swap(frame.bgr, ready_);
  } else {
    ready_.copyTo(frame.bgr);
  }
  frame.captured = last_given_ = std::max(ready_captured_, last_given_);
  return ReadStatus::kFrame;
}

void ReconnectingDevice::work(bool is_open) {
  milliseconds next_pause = pauses_.first;
  for (;;) {
    if (is_open) {
      // A device that opens but gives nothing is no better than one that does not open.
      if (deliver_until_lost()) next_pause = pauses_.first;
      device_->close();
      is_open = false;
    }
    if (!pause(next_pause)) return;
    next_pause = std::min(2 * next_pause, pauses_.longest);
    const std::optional<std::string> refusal = try_open();
    if (refusal) note_trouble("is not there", *refusal);
    is_open = !refusal;
  }
}

/// @return false when it is time to end.
bool ReconnectingDevice::pause(milliseconds duration) {
  std::unique_lock lock(mutex_);
  return !ending_.wait_for(lock, duration, [this] { return end_; });
}

bool ReconnectingDevice::is_ending() {
  const std::lock_guard lock(mutex_);
  return end_;
}

/// @return whether any picture came.
bool ReconnectingDevice::deliver_until_lost() {
  bool any = false;
  for (;;) {
    Timestamp captured{0};
    const std::optional<std::string> failure = try_read(captured);
    if (is_ending()) return any;
    if (failure) {
      note_trouble("gives no picture", *failure);
      return any;
    }
    note_picture();
    any = true;
    const std::lock_guard lock(mutex_);
    std::swap(filling_, ready_);
    ready_captured_ = captured;
    fresh_ = true;
    arrived_.notify_one();
  }
}

std::optional<std::string> ReconnectingDevice::try_open() {
  try {
    return device_->open();
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::optional<std::string> ReconnectingDevice::try_read(Timestamp& captured) {
  try {
    if (auto failure = device_->read(filling_, captured)) return failure;
    if (filling_.empty()) return "the picture is empty";
    return std::nullopt;
  } catch (const std::exception& e) {
    return e.what();
  }
}

void ReconnectingDevice::note_trouble(const std::string& what, const std::string& reason) {
  if (trouble_ == reason) return;
  if (trouble_.empty()) trouble_since_ = steady_clock::now();
  trouble_ = reason;
  reporter_.warn(fmt::format("{} {}: {}; trying again until it is back", name_, what, reason));
}

void ReconnectingDevice::note_picture() {
  if (trouble_.empty()) return;
  trouble_.clear();
  const std::chrono::duration<double> away = steady_clock::now() - trouble_since_;
  reporter_.warn(fmt::format("{} is back after {:.1f} s", name_, away.count()));
}

}  // namespace maggic::live
