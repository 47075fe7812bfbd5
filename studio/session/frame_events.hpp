#pragma once
/// Tells listeners how frames go, a few times a second.

#include <chrono>
#include <cstdint>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "maggic/frame_result.hpp"
#include "maggic/step_statistics.hpp"
#include "studio/session/event_log.hpp"

namespace maggic::studio {

/// One thread at a time; adds at most ten events a second, each with the figures of the time since
/// the one before.
class FrameEvents {
 public:
  /// @param log outlives this.
  explicit FrameEvents(EventLog& log) : log_(log) {}

  /// @param dropped captured but never processed, so far.
  void add(const FrameResult& result, std::uint64_t processed, std::uint64_t dropped);

 private:
  using Clock = std::chrono::steady_clock;

  nlohmann::json robots(const Detections& detections);
  static nlohmann::json ball(const Detections& detections);
  nlohmann::json times() const;

  EventLog& log_;
  Clock::time_point last_event_{};
  std::uint64_t processed_at_last_ = 0;
  StepStatistics times_;
  /// When each robot, by team and id, was seen last.
  std::map<std::pair<Team, int>, std::uint64_t> last_seen_;
};

}  // namespace maggic::studio
