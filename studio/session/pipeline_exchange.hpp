#pragma once
/// Hands a new pipeline to the run loop between two frames.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "maggic/pipeline_builder.hpp"

namespace maggic::studio {

/// What a new pipeline keeps of the one it replaces.
enum class History {
  kKept,  ///< Tracks and light go on: the pipelines differ in their colour stages only.
  kNew,
};

/// One thread runs the pipeline and calls `between_frames`; any others call the rest.
class PipelineExchange {
 public:
  /// @param running outlives the exchange.
  explicit PipelineExchange(BuiltPipeline& running) : running_(running) {}

  /// Waits until the run loop has taken `next`, or until `timeout`, after which it is still taken
  /// as soon as a frame comes; one that was never taken is replaced.
  /// @return whether it is in use.
  bool offer(std::unique_ptr<Pipeline> next, History history, std::chrono::milliseconds timeout);

  /// On the run loop's thread: takes what is offered. Never waits: while someone looks at the
  /// pipeline it is left for the next frame.
  /// @return whether the pipeline is another one now.
  bool between_frames();

  /// Calls `look` with the pipeline in use, which is not exchanged meanwhile. It may read what does
  /// not change while frames are processed: palette, colour table, colour stages.
  void with_pipeline(const std::function<void(const Pipeline&)>& look);

 private:
  BuiltPipeline& running_;
  std::mutex in_use_;  ///< Held while `running_.pipeline` is exchanged or looked at.
  std::mutex mutex_;
  std::condition_variable taken_;
  std::atomic<bool> waiting_{false};
  std::unique_ptr<Pipeline> next_;
  History history_ = History::kNew;
  std::unique_ptr<Pipeline> spent_;  ///< Destroyed by the next offer rather than between frames.
};

}  // namespace maggic::studio
