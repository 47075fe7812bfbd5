#include "video_clock.hpp"

#include <cmath>

namespace maggic::video {
namespace {

constexpr double kUsualRate = 30.0;
constexpr double kLongestStep_ms = 60'000.0;

Timestamp from_ms(double ms) { return Timestamp(std::llround(ms * 1e6)); }

}  // namespace

double plausible_rate(double frames_per_second) {
  // Above: the time base of a container that does not know its rate, such as 90000.
  return frames_per_second > 0.01 && frames_per_second <= 10'000.0 ? frames_per_second : 0.0;
}

VideoClock::VideoClock(double frames_per_second)
    : period_(from_ms(1000.0 / (frames_per_second > 0.0 ? frames_per_second : kUsualRate))) {}

Timestamp VideoClock::next(double position_ms) {
  const double step_ms = position_ms - previous_ms_;
  const bool advances = step_ms > 0.0 && step_ms <= kLongestStep_ms;
  const bool first = !started_;
  if (!first && !restarted_ && advances) {
    time_ = anchor_time_ + from_ms(position_ms - anchor_ms_);
  } else {
    if (!first) time_ += period_;
    guessed_ = guessed_ || (!first && !restarted_);
    anchor_ms_ = position_ms;
    anchor_time_ = time_;
  }
  started_ = true;
  restarted_ = false;
  previous_ms_ = position_ms;
  return time_;
}

}  // namespace maggic::video
