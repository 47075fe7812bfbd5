#pragma once
/// A few hundred measured times in three numbers.

#include <chrono>
#include <span>

namespace maggic {

/// The shortest shows what the machine can do, the median what to expect, p99 what a match meets.
struct DurationFigures {
  std::chrono::nanoseconds min{0};
  std::chrono::nanoseconds p50{0};
  std::chrono::nanoseconds p99{0};
};

/// Quantiles by nearest rank: the shortest of `times` that the share lies at or below, so p99 of
/// fewer than 100 times is the longest.
/// @param times is sorted. @return zeros when there are none.
DurationFigures figures_of(std::span<std::chrono::nanoseconds> times);

}  // namespace maggic
