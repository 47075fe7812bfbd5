#pragma once
/// Ends waiting early.

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace maggic::studio {

/// Thread-safe; once raised it stays raised.
class StopFlag {
 public:
  void raise() {
    {
      const std::lock_guard lock(mutex_);
      raised_ = true;
    }
    changed_.notify_all();
  }
  bool raised() const {
    const std::lock_guard lock(mutex_);
    return raised_;
  }
  /// Waits until `time` or for the flag. @return whether it is raised.
  bool wait_until(std::chrono::steady_clock::time_point time) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, time, [this] { return raised_; });
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  bool raised_ = false;
};

}  // namespace maggic::studio
