#pragma once
/// One sink on a thread of its own behind a bounded queue.

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "maggic/pipeline_builder.hpp"
#include "maggic/runner.hpp"
#include "pipeline/frame_queue.hpp"

namespace maggic {

/// Opens, feeds and closes a sink. A sink that fails to open takes no frames; one that fails to
/// write is given the next frame all the same.
class SinkThread {
 public:
  /// Starts the thread. @param sink outlives this, as do the others.
  SinkThread(NamedStage<Sink>& sink, const RunInfo& info, std::size_t queue_frames,
             Reporter& reporter);
  ~SinkThread();
  SinkThread(const SinkThread&) = delete;
  SinkThread& operator=(const SinkThread&) = delete;

  /// Never waits. @return false when the queue was full and the frame was dropped for this sink.
  bool offer(const FramePtr& frame);
  /// Waits for room; once `stop` is set, no longer than `patience`.
  /// @return false when there was none even then and the frame was dropped for this sink.
  bool give(const FramePtr& frame, const std::atomic<bool>& stop,
            std::chrono::milliseconds patience);

  /// Nothing more will be offered or given; the sink is closed once it wrote what is queued.
  void close() { queue_.close(); }

  /// Closes, waits for that, and ends the thread.
  SinkSummary finish();

 private:
  void work();
  void fail(const std::string& message);

  NamedStage<Sink>& sink_;
  const RunInfo& info_;
  Reporter& reporter_;
  FrameQueue queue_;
  SinkSummary summary_;  ///< Written by the thread; `dropped` by the frame path.
  std::uint64_t dropped_ = 0;
  std::thread thread_;
};

}  // namespace maggic
