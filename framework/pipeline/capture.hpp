#pragma once
/// Reads a source on a thread of its own and hands frames on.

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "maggic/frame_pool.hpp"
#include "maggic/pipeline_builder.hpp"
#include "pipeline/frame_queue.hpp"

namespace maggic {

/// Capture of one run. Live: the newest frame wins and what it displaces is counted as dropped.
/// Recorded: nothing is lost, the source waits for the frame path.
class Capture {
 public:
  /// Starts the thread. @param source open already; outlives this, as do the others.
  Capture(NamedStage<Source>& source, bool live, bool paced, FramePool& pool,
          const std::atomic<bool>& stop);
  /// Ends the thread, within the time one `read` may take.
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  /// The next frame; null when none came within `timeout` or none will.
  FramePtr next(std::chrono::milliseconds timeout) { return queue_.pop(timeout); }
  /// True once the source ended or failed and every frame was taken.
  bool finished() { return queue_.finished(); }

  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }
  /// What ended the capture early; empty if nothing did. Meaningful once `finished`.
  const std::string& error() const { return error_; }

 private:
  void work();
  void read_all();
  void wait_until_due(Timestamp captured);
  bool stopping() const { return stop_ || ended_; }

  NamedStage<Source>& source_;
  const bool live_;
  const bool paced_;
  FramePool& pool_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> dropped_{0};
  std::string error_;
  FrameQueue queue_;
  std::optional<Timestamp> last_captured_;
  Timestamp first_captured_{0};
  std::chrono::steady_clock::time_point first_given_;
  std::thread thread_;
};

}  // namespace maggic
