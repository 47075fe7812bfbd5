#pragma once
/// The newest frame with its results, kept for those who want to look at it.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"

namespace maggic::studio {

/// A frame of its own, apart from the run loop's pool.
struct KeptFrame {
  std::uint64_t number = 0;  ///< Counts up from 1 over the frames kept.
  FrameResult result;
  std::shared_ptr<const Field> field;
};

/// Safe from any thread. Copies at most 30 frames a second while someone asks, and one a second
/// otherwise.
class NewestFrame {
 public:
  /// Takes a copy if one is wanted.
  void offer(const FrameResult& result, const Field& field);

  /// Takes a copy.
  void keep(const FrameResult& result, const Field& field);

  /// The newest frame kept, waiting for one newer than `after`; null when none came in time.
  std::shared_ptr<const KeptFrame> next(std::uint64_t after, std::chrono::milliseconds timeout);

  /// Null when none was kept yet.
  std::shared_ptr<const KeptFrame> newest();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_wanted(Clock::time_point now);

  std::mutex mutex_;
  std::condition_variable kept_;
  std::shared_ptr<const KeptFrame> newest_;
  Clock::time_point last_asked_{};
  Clock::time_point last_kept_{};
  std::uint64_t count_ = 0;
};

}  // namespace maggic::studio
