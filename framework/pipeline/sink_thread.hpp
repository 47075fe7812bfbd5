#pragma once
/// One sink on a thread of its own behind a bounded queue.

#include <atomic>
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
  /// Waits for room. Every frame given is written.
  void give(const FramePtr& frame);

  /// Lets the sink write what is queued, closes it, and ends the thread.
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
