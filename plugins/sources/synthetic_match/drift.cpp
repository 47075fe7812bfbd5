#include "drift.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "maggic/color_temperature.hpp"

namespace maggic::synthetic_match {

std::array<double, 3> Drift::gains_at(double time_s) const {
  if (is_still()) return {1.0, 1.0, 1.0};
  const double period = keyframes_.back().time_s;
  if (end_ == DriftEnd::kRepeat && period > 0.0) time_s = std::fmod(time_s, period);
  const auto after = std::ranges::upper_bound(keyframes_, time_s, {}, &DriftKeyframe::time_s);
  const auto before = after == keyframes_.begin() ? after : std::prev(after);
  DriftKeyframe now = *before;
  if (after != keyframes_.end() && after != before) {
    const double u = (time_s - before->time_s) / (after->time_s - before->time_s);
    const double blend = u * u * (3.0 - 2.0 * u);
    now.brightness = std::lerp(before->brightness, after->brightness, blend);
    now.color_temperature_k =
        std::lerp(before->color_temperature_k, after->color_temperature_k, blend);
  }
  std::array<double, 3> gains = lamp_gains(now.color_temperature_k);
  for (double& gain : gains) gain *= now.brightness;
  return gains;
}

}  // namespace maggic::synthetic_match
