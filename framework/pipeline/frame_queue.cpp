#include "pipeline/frame_queue.hpp"

#include <utility>

namespace maggic {

bool FrameQueue::push(const FramePtr& frame, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!not_full_.wait_for(lock, timeout, [this] { return !frames_.full(); })) return false;
  frames_.push_back(frame);
  not_empty_.notify_one();
  return true;
}

bool FrameQueue::push_newest(FramePtr frame) {
  FramePtr dropped;  // given back to the pool after the lock is let go
  const std::lock_guard lock(mutex_);
  if (frames_.full()) {
    dropped = std::move(frames_.front());
    frames_.pop_front();
  }
  frames_.push_back(std::move(frame));
  not_empty_.notify_one();
  return dropped != nullptr;
}

FramePtr FrameQueue::pop(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!not_empty_.wait_for(lock, timeout, [this] { return !frames_.empty() || closed_; }) ||
      frames_.empty()) {
    return nullptr;
  }
  FramePtr frame = std::move(frames_.front());
  frames_.pop_front();
  not_full_.notify_one();
  return frame;
}

void FrameQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  not_empty_.notify_all();
}

bool FrameQueue::finished() {
  const std::lock_guard lock(mutex_);
  return closed_ && frames_.empty();
}

}  // namespace maggic
