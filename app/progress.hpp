#pragma once
/// Shows how a run is going while it goes.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "app/console.hpp"
#include "app/live_line.hpp"

namespace maggic::app {

/// Prints on a thread of its own, so a slow terminal never delays a frame: ten times a second on a
/// terminal, every two seconds elsewhere. Stops when destroyed.
class Progress {
 public:
  /// @param max_taken frames the run will take at most, when limited.
  Progress(Console& console, std::optional<std::uint64_t> max_taken);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Called after each processed frame, on the frame path's thread: copies a few numbers.
  /// @param total frames the source will give, when known.
  void update(const FrameResult& result, const RunSummary& summary,
              std::optional<std::uint64_t> total);

 private:
  using Clock = std::chrono::steady_clock;

  void show_until_done();

  Console& console_;
  const Clock::time_point started_ = Clock::now();
  std::atomic<bool> quantiles_wanted_{true};  // they cost some µs, so only before they are shown
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  LiveState state_;
  std::thread thread_;  // last: uses all of the above
};

}  // namespace maggic::app
