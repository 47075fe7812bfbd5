#pragma once
/// Colours as peaks of a hue histogram.

#include <array>
#include <cstdint>
#include <vector>

namespace maggic::calibration {

inline constexpr int kHues = 256;

/// Weight of every hue; circular.
using HueHistogram = std::array<double, kHues>;

/// When two peaks are two colours.
struct PeakRules {
  double sigma = 2.0;        ///< Of the smoothing, in hue steps.
  int min_distance = 6;      ///< Nearer peaks are one colour.
  double max_valley = 0.6;   ///< Of the smaller peak: a shallower valley does not part two colours.
  double min_height = 0.08;  ///< Of the highest peak: lower ones are none.
};

struct HueClusters {
  std::vector<int> peaks;  ///< Hues, ascending.
  /// For each hue the index of the peak whose slope it lies on; borders are in the valleys, in the
  /// middle of an empty one.
  std::array<std::uint8_t, kHues> of_hue{};
};

/// No peaks for an empty histogram; at most 255 otherwise.
HueClusters cluster_hues(const HueHistogram& histogram, const PeakRules& rules);

}  // namespace maggic::calibration
