#pragma once
/// A fixed set of FrameResults passed between threads without copying or allocating.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include <boost/smart_ptr/intrusive_ptr.hpp>

#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"

namespace maggic {

class FramePool;

/// A FrameResult on loan from a pool.
class PooledFrame {
 public:
  FrameResult result;
  /// The transform of this frame's size, shared with the pipeline: see Pipeline::field.
  std::shared_ptr<const Field> field;

 private:
  friend class FramePool;
  friend void intrusive_ptr_add_ref(PooledFrame* frame) noexcept;
  friend void intrusive_ptr_release(PooledFrame* frame) noexcept;
  std::atomic<int> owners_{0};
  FramePool* pool_ = nullptr;
};

/// Shared between the frame path and every sink that still works on it; the last owner gives the
/// slot back to its pool.
using FramePtr = boost::intrusive_ptr<PooledFrame>;

/// Outlives every FramePtr it gave out. Thread-safe.
class FramePool {
 public:
  /// @param slots at least 1.
  explicit FramePool(std::size_t slots);

  /// A free slot, its buffers as the last user left them; null when none came free within
  /// `timeout`. Slots never used come first, so that all of them have their buffers early in a run;
  /// then the one returned last, whose buffers are likeliest in the cache.
  FramePtr acquire(std::chrono::milliseconds timeout);

 private:
  friend void intrusive_ptr_release(PooledFrame* frame) noexcept;
  void give_back(PooledFrame* frame) noexcept;

  std::vector<std::unique_ptr<PooledFrame>> slots_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::size_t first_unused_ = 0;    ///< This slot and those behind it were never given out.
  std::vector<PooledFrame*> free_;  ///< Of the others.
};

}  // namespace maggic
