#include "calibration/plateau.hpp"

#include <algorithm>
#include <cmath>

namespace maggic::calibration {

Plateau find_plateau(std::span<const double> worth, double tolerance) {
  Plateau best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < worth.size(); ++i) {
    if (worth[i] <= 0.0) continue;
    const auto belongs = [&](std::size_t j) {
      return std::abs(worth[j] - worth[i]) <= tolerance * worth[i];
    };
    Plateau here{i, i};
    while (here.first > 0 && belongs(here.first - 1)) --here.first;
    while (here.last + 1 < worth.size() && belongs(here.last + 1)) ++here.last;
    const double score = worth[i] * std::sqrt(static_cast<double>(here.last - here.first + 1));
    if (score <= best_score) continue;
    best_score = score;
    best = here;
  }
  if (best_score > 0.0) return best;
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(worth) - worth.begin());
  return {largest, largest};
}

}  // namespace maggic::calibration
