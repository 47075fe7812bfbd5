#pragma once
/// Capture times of a recording's frames from what its container says.

#include "maggic/frame.hpp"

namespace maggic::video {

/// A container's frame rate where it is plausible, else 0.
double plausible_rate(double frames_per_second);

/// Turns positions into times that always run forward. The first frame is at 0; from then on the
/// positions' own distances count, so a variable frame rate is kept. A position that does not
/// advance, is no number or jumps by more than a minute is replaced by one frame period.
class VideoClock {
 public:
  /// @param frames_per_second 0 when unknown: replaced positions are then 1/30 s apart.
  explicit VideoClock(double frames_per_second);

  /// The time of the next frame. @param position_ms where the container says that it is.
  Timestamp next(double position_ms);

  /// The recording begins again: its next frame comes one frame period after the last.
  void restart() { restarted_ = true; }

  /// Whether any position had to be replaced.
  bool guessed() const { return guessed_; }

 private:
  const Timestamp period_;
  bool started_ = false;
  bool restarted_ = false;
  bool guessed_ = false;
  double previous_ms_ = 0.0;
  Timestamp time_{0};
  // Times are taken from the last replaced position on, so that rounding does not add up.
  double anchor_ms_ = 0.0;
  Timestamp anchor_time_{0};
};

}  // namespace maggic::video
