#include "maggic/duration_figures.hpp"

#include <algorithm>
#include <cstddef>

namespace maggic {

DurationFigures figures_of(std::span<std::chrono::nanoseconds> times) {
  if (times.empty()) return {};
  std::ranges::sort(times);
  const auto at_percent = [&](std::size_t percent) {
    return times[(percent * times.size() + 99) / 100 - 1];
  };
  return {times.front(), at_percent(50), at_percent(99)};
}

}  // namespace maggic
