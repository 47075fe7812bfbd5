#include "maggic/duration_figures.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using std::chrono::nanoseconds;

std::vector<nanoseconds> descending_from(int count) {
  std::vector<nanoseconds> times;
  for (int i = count; i > 0; --i) times.emplace_back(i);
  return times;
}

TEST(DurationFigures, AreNearestRanks) {
  std::vector<nanoseconds> times = descending_from(200);
  const DurationFigures figures = figures_of(times);
  EXPECT_EQ(figures.min, nanoseconds(1));
  EXPECT_EQ(figures.p50, nanoseconds(100));
  EXPECT_EQ(figures.p99, nanoseconds(198));
}

TEST(DurationFigures, OfOneTimeAreThatTime) {
  std::vector<nanoseconds> times{nanoseconds(7)};
  const DurationFigures figures = figures_of(times);
  EXPECT_EQ(figures.min, nanoseconds(7));
  EXPECT_EQ(figures.p50, nanoseconds(7));
  EXPECT_EQ(figures.p99, nanoseconds(7));
}

TEST(DurationFigures, OfFewTimesEndWithTheLongest) {
  std::vector<nanoseconds> times = descending_from(10);
  EXPECT_EQ(figures_of(times).p99, nanoseconds(10));
}

TEST(DurationFigures, OfNothingAreZero) { EXPECT_EQ(figures_of({}).p99, nanoseconds(0)); }

RC_GTEST_PROP(DurationFigures, AreOrderedAndCutTheTimesInTheirShares,
              (std::vector<std::uint16_t> numbers)) {
  RC_PRE(!numbers.empty());
  std::vector<nanoseconds> times(numbers.begin(), numbers.end());
  const DurationFigures figures = figures_of(times);
  RC_ASSERT(figures.min <= figures.p50);
  RC_ASSERT(figures.p50 <= figures.p99);
  const auto at_or_below = [&](nanoseconds limit) {
    return static_cast<std::size_t>(
        std::ranges::count_if(times, [&](nanoseconds time) { return time <= limit; }));
  };
  RC_ASSERT(100 * at_or_below(figures.p50) >= 50 * times.size());
  RC_ASSERT(100 * at_or_below(figures.p99) >= 99 * times.size());
  RC_ASSERT(100 * at_or_below(figures.p50 - nanoseconds(1)) < 50 * times.size());
}

}  // namespace
}  // namespace maggic
