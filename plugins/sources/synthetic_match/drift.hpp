#pragma once
/// Light that changes in the course of a match.

#include <array>
#include <vector>

namespace maggic::synthetic_match {

/// What the light is at one moment.
struct DriftKeyframe {
  double time_s = 0.0;
  double brightness = 1.0;
  double color_temperature_k = 6500.0;
};

enum class DriftEnd {
  kHold,    ///< The last keyframe's light stays.
  kRepeat,  ///< All starts again: the last keyframe's time is the period.
};

/// Factors on red, green and blue over time. Between two keyframes brightness and temperature
/// follow 3u² − 2u³ of the time u gone by, so nothing jumps and nothing has a kink; before the
/// first one its light holds.
class Drift {
 public:
  /// @param keyframes times ascending; empty: the light never changes.
  Drift(std::vector<DriftKeyframe> keyframes, DriftEnd end)
      : keyframes_(std::move(keyframes)), end_(end) {}

  bool is_still() const { return keyframes_.empty(); }
  std::array<double, 3> gains_at(double time_s) const;

 private:
  std::vector<DriftKeyframe> keyframes_;
  DriftEnd end_;
};

}  // namespace maggic::synthetic_match
