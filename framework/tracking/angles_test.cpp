#include "tracking/angles.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic::tracking {
namespace {

double angle_of(std::int32_t number) { return number * (10.0 * kPi / 2147483648.0); }

RC_GTEST_PROP(Angles, TheShortWayRoundIsTheRemainderToTheLastBit, ()) {
  const double rad = angle_of(*rc::gen::inRange(-2147483647, 2147483647));
  RC_ASSERT(remainder_of(rad, kPi) == std::remainder(rad, kPi));
  RC_ASSERT(remainder_of(rad, 2.0 * kPi) == std::remainder(rad, 2.0 * kPi));
}

TEST(Angles, AreTheRemainderAtTheBordersAsWell) {
  for (const double quarters : {-8.0, -6.0, -5.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 6.0}) {
    const double border = quarters * 0.5 * kPi;
    for (const double rad :
         {std::nextafter(border, -100.0), border, std::nextafter(border, 100.0)}) {
      EXPECT_EQ(remainder_of(rad, kPi), std::remainder(rad, kPi)) << rad;
      EXPECT_EQ(remainder_of(rad, 2.0 * kPi), std::remainder(rad, 2.0 * kPi)) << rad;
    }
  }
}

TEST(Angles, ATurnEndsAtPiAndALineAtHalfOfIt) {
  EXPECT_EQ(wrap_turn(-kPi), kPi);
  EXPECT_EQ(wrap_turn(kPi), kPi);
  EXPECT_NEAR(wrap_turn(1.5 * kPi), -0.5 * kPi, 1e-12);
  EXPECT_NEAR(wrap_line(0.75 * kPi), -0.25 * kPi, 1e-12);
  EXPECT_NEAR(wrap_line(-7.0 * kPi - 0.1), -0.1, 1e-12);
}

}  // namespace
}  // namespace maggic::tracking
