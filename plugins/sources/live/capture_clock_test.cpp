#include "live/capture_clock.hpp"

#include <limits>
#include <thread>

#include <gtest/gtest.h>

namespace maggic::live {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kNow = std::chrono::hours(30);  // after start-up
constexpr double kNow_ms = 30.0 * 3'600'000.0;

TEST(CaptureClock, TakesTheDriversStampOfTheLastSecond) {
  EXPECT_EQ(age_by_driver(kNow_ms - 12.5, kNow), nanoseconds(12'500'000));
}

TEST(CaptureClock, TakesNothingThatCannotBeSuchAStamp) {
  for (const double stamp_ms :
       {0.0, 40.0, -1.0, kNow_ms + 1.0, kNow_ms - 1500.0, 1.7e12,
        std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(age_by_driver(stamp_ms, kNow), nanoseconds(0)) << stamp_ms;
  }
}

TEST(CaptureClock, CountsFromTheUnixEpoch) {
  const CaptureClock clock;
  const nanoseconds unix_now = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_LT(std::chrono::abs(clock.captured(0.0) - unix_now), seconds(1));
}

TEST(CaptureClock, PutsTheStampOnTheSameScale) {
  const CaptureClock clock;
  const nanoseconds monotonic = std::chrono::steady_clock::now().time_since_epoch();
  const double stamp_ms = static_cast<double>(monotonic.count()) / 1e6;
  std::this_thread::sleep_for(milliseconds(3));
  const Timestamp by_stamp = clock.captured(stamp_ms);
  EXPECT_GE(clock.now() - by_stamp, milliseconds(3));
  EXPECT_LT(clock.now() - by_stamp, seconds(1));
}

}  // namespace
}  // namespace maggic::live
