#include "maggic/frame_pool.hpp"

#include <stdexcept>

namespace maggic {

void intrusive_ptr_add_ref(PooledFrame* frame) noexcept {
  frame->owners_.fetch_add(1, std::memory_order_relaxed);
}

void intrusive_ptr_release(PooledFrame* frame) noexcept {
  // Release publishes this owner's reads and writes, acquire takes in everybody else's, before the
  // slot can be filled again.
  if (frame->owners_.fetch_sub(1, std::memory_order_acq_rel) == 1) frame->pool_->give_back(frame);
}

FramePool::FramePool(std::size_t slots) {
  if (slots == 0) throw std::invalid_argument("a frame pool needs at least one slot");
  slots_.reserve(slots);
  free_.reserve(slots);
  for (std::size_t i = 0; i < slots; ++i) {
    slots_.push_back(std::make_unique<PooledFrame>());
    slots_.back()->pool_ = this;
  }
}

FramePtr FramePool::acquire(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (first_unused_ < slots_.size()) return FramePtr(slots_[first_unused_++].get());
  if (!freed_.wait_for(lock, timeout, [this] { return !free_.empty(); })) return nullptr;
  PooledFrame* frame = free_.back();
  free_.pop_back();
  return FramePtr(frame);
}

void FramePool::give_back(PooledFrame* frame) noexcept {
  const std::lock_guard lock(mutex_);
  free_.push_back(frame);
  // Notified under the lock: the pool may be destroyed as soon as the last slot is home.
  freed_.notify_one();
}

}  // namespace maggic
