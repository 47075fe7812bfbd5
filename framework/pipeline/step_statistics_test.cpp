#include "maggic/step_statistics.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

TEST(DurationHistogram, IsZeroWhileEmpty) {
  const DurationHistogram empty;
  EXPECT_EQ(empty.quantile(0.5), nanoseconds(0));
  EXPECT_EQ(empty.mean(), nanoseconds(0));
}

TEST(DurationHistogram, QuantilesAreExactToOnePercent) {
  DurationHistogram histogram;
  for (int i = 1; i <= 1000; ++i) histogram.add(microseconds(i));
  EXPECT_NEAR(static_cast<double>(histogram.quantile(0.5).count()), 500e3, 5e3);
  EXPECT_NEAR(static_cast<double>(histogram.quantile(0.99).count()), 990e3, 9.9e3);
  EXPECT_EQ(histogram.max(), microseconds(1000));
  EXPECT_EQ(histogram.mean(), nanoseconds(500'500));
}

RC_GTEST_PROP(DurationHistogram, QuantilesNeverDecreaseNorPassTheMaximum,
              (const std::vector<std::uint32_t>& values)) {
  DurationHistogram histogram;
  for (const std::uint32_t value : values) histogram.add(nanoseconds(value));
  nanoseconds last(0);
  for (const double q : {0.0, 0.1, 0.5, 0.9, 0.99, 1.0}) {
    RC_ASSERT(histogram.quantile(q) >= last);
    last = histogram.quantile(q);
  }
  RC_ASSERT(last <= histogram.max());
}

TEST(StepStatistics, TheFramePathIsEverythingAfterReading) {
  StepTimes times;
  times[Step::kRead] = microseconds(1000);
  times[Step::kSegment] = microseconds(100);
  times[Step::kBlobs] = microseconds(20);
  times[Step::kTrack] = microseconds(30);
  StepStatistics statistics;
  statistics.add(times);
  EXPECT_EQ(statistics.frame_path().max(), microseconds(150));
  EXPECT_EQ(statistics.of(Step::kRead).max(), microseconds(1000));
}

}  // namespace
}  // namespace maggic
