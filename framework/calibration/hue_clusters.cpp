#include "calibration/hue_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace maggic::calibration {
namespace {

constexpr std::size_t at(int hue) { return static_cast<std::size_t>((hue + kHues) % kHues); }

HueHistogram smoothed(const HueHistogram& raw, double sigma) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  HueHistogram smooth{};
  for (int i = -radius; i <= radius; ++i) {
    const double weight = std::exp(-0.5 * i * i / (sigma * sigma));
    for (int hue = 0; hue < kHues; ++hue) smooth[at(hue)] += weight * raw[at(hue + i)];
  }
  return smooth;
}

double lowest_between(const HueHistogram& histogram, int from, int to) {
  double lowest = histogram[at(from)];
  for (int hue = from; hue != to; hue = (hue + 1) % kHues) {
    lowest = std::min(lowest, histogram[at(hue)]);
  }
  return lowest;
}

std::vector<int> local_maxima(const HueHistogram& histogram, double min_height) {
  std::vector<int> peaks;
  for (int hue = 0; hue < kHues; ++hue) {
    const double here = histogram[at(hue)];
    if (here > histogram[at(hue - 1)] && here >= histogram[at(hue + 1)] && here >= min_height) {
      peaks.push_back(hue);
    }
  }
  return peaks;
}

/// Joins the least separate pair of neighbours until all stand apart.
void join_neighbours(const HueHistogram& histogram, const PeakRules& rules,
                     std::vector<int>& peaks) {
  while (peaks.size() > 1) {
    std::size_t worst = peaks.size();
    double worst_ratio = 0.0;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const int a = peaks[i];
      const int b = peaks[(i + 1) % peaks.size()];
      const double valley =
          lowest_between(histogram, a, b) / std::min(histogram[at(a)], histogram[at(b)]);
      const bool near = (b - a + kHues) % kHues < rules.min_distance;
      const double ratio = near ? 1.0 + valley : valley;
      if (ratio > rules.max_valley && ratio > worst_ratio) {
        worst = i;
        worst_ratio = ratio;
      }
    }
    if (worst == peaks.size()) return;
    const std::size_t next = (worst + 1) % peaks.size();
    const bool next_is_higher = histogram[at(peaks[worst])] < histogram[at(peaks[next])];
    peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(next_is_higher ? worst : next));
  }
}

/// How many steps after `from` the lowest stretch before `from + length` has its middle.
int steps_to_border(const HueHistogram& histogram, int from, int length) {
  double lowest = histogram[at(from)];
  int first = 0;
  int last = 0;
  for (int k = 0; k < length; ++k) {
    const double here = histogram[at(from + k)];
    if (here < lowest) {
      lowest = here;
      first = k;
    }
    if (here <= lowest) last = k;
  }
  return (first + last) / 2;
}

}  // namespace

HueClusters cluster_hues(const HueHistogram& histogram, const PeakRules& rules) {
  const HueHistogram smooth = smoothed(histogram, rules.sigma);
  const double highest = *std::ranges::max_element(smooth);
  HueClusters clusters;
  if (highest <= 0.0) return clusters;
  clusters.peaks = local_maxima(smooth, rules.min_height * highest);
  if (clusters.peaks.empty()) clusters.peaks = {0};  // every hue alike
  join_neighbours(smooth, rules, clusters.peaks);
  const std::size_t count = clusters.peaks.size();
  if (count == 1) return clusters;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const int from = clusters.peaks[i];
    const int length = (clusters.peaks[next] - from + kHues) % kHues;
    const int border = steps_to_border(smooth, from, length);
    for (int k = 0; k < length; ++k) {
      clusters.of_hue[at(from + k)] = static_cast<std::uint8_t>(k <= border ? i : next);
    }
  }
  return clusters;
}

}  // namespace maggic::calibration
