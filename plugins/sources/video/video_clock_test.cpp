#include "video_clock.hpp"

#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic::video {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

std::vector<double> times_ms(VideoClock& clock, const std::vector<double>& positions_ms) {
  std::vector<double> result;
  for (const double position : positions_ms) {
    result.push_back(static_cast<double>(clock.next(position).count()) / 1e6);
  }
  return result;
}

TEST(VideoClock, KeepsAVariableRateAndBeginsAtZero) {
  VideoClock clock(25);
  EXPECT_THAT(times_ms(clock, {1000, 1040, 1120, 1130}), ElementsAre(0, 40, 120, 130));
  EXPECT_FALSE(clock.guessed());
}

TEST(VideoClock, CountsFramesWhereTheContainerHasNoPositions) {
  VideoClock clock(50);
  EXPECT_THAT(times_ms(clock, {0, 0, 0, 0}), ElementsAre(0, 20, 40, 60));
  EXPECT_TRUE(clock.guessed());
  VideoClock unknown_rate(0);
  EXPECT_NEAR(times_ms(unknown_rate, {-3.7e20, -3.7e20}).back(), 1000.0 / 30, 1e-5);
}

TEST(VideoClock, BridgesJumpsByOnePeriod) {
  VideoClock clock(25);
  EXPECT_THAT(times_ms(clock, {0, 40, 95'443'717, 95'443'757, 80, 120}),
              ElementsAre(0, 40, 80, 120, 160, 200));
  EXPECT_TRUE(clock.guessed());
}

TEST(VideoClock, SurvivesPositionsThatAreNoNumbers) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  VideoClock clock(25);
  EXPECT_THAT(times_ms(clock, {0, kNan, 40, kInfinite, kInfinite, 80, 120}),
              ElementsAre(0, 40, 80, 120, 160, 200, 240));
}

TEST(VideoClock, RunsOnWhenTheRecordingBeginsAgain) {
  VideoClock clock(25);
  times_ms(clock, {0, 40, 120});
  clock.restart();
  EXPECT_THAT(times_ms(clock, {0, 40, 120}), ElementsAre(160, 200, 280));
  EXPECT_FALSE(clock.guessed());
}

TEST(VideoClock, DoesNotDriftOverAMillionFrames) {
  VideoClock clock(29.97);
  Timestamp last{0};
  for (int i = 0; i <= 1'000'000; ++i) last = clock.next(i * 1001.0 / 30.0);
  EXPECT_NEAR(static_cast<double>(last.count()), 1e6 * 1001.0 / 30.0 * 1e6, 10.0);
}

RC_GTEST_PROP(VideoClock, AlwaysRunsForward, (const std::vector<double>& positions_ms)) {
  VideoClock clock(30);
  Timestamp last{-1};
  for (const double position : positions_ms) {
    const Timestamp time = clock.next(position);
    RC_ASSERT(time >= last);
    last = time;
  }
}

TEST(PlausibleRate, IsNeitherZeroNorATimeBase) {
  EXPECT_EQ(plausible_rate(29.97), 29.97);
  EXPECT_EQ(plausible_rate(1.0 / 60), 1.0 / 60);
  for (const double rate : {0.0, -1.0, 90'000.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(plausible_rate(rate), 0.0) << rate;
  }
}

}  // namespace
}  // namespace maggic::video
