#pragma once
/// A bounded queue of pooled frames between two threads.

#include <chrono>
#include <condition_variable>
#include <mutex>

#include <boost/circular_buffer.hpp>

#include "maggic/frame_pool.hpp"

namespace maggic {

/// First in, first out; allocates only when made. Closed once by the writer; the reader then still
/// gets what is inside.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t capacity) : frames_(capacity) {}

  /// Waits up to `timeout` for room. @return false, with nothing queued, when there was none.
  bool push(const FramePtr& frame, std::chrono::milliseconds timeout);

  /// Puts `frame` in at once, dropping the oldest one if the queue is full.
  /// @return whether one was dropped.
  bool push_newest(FramePtr frame);

  /// The oldest frame; null when none came within `timeout` or the queue is closed and empty.
  FramePtr pop(std::chrono::milliseconds timeout);

  /// Nothing more will be pushed.
  void close();

  /// Closed and empty.
  bool finished();

 private:
  std::mutex mutex_;
  std::condition_variable not_full_;
  std::condition_variable not_empty_;
  boost::circular_buffer<FramePtr> frames_;
  bool closed_ = false;
};

}  // namespace maggic
