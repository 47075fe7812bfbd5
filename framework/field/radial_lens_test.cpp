#include "maggic/radial_lens.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

/// A number in [low, high], spread evenly.
double in_range(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 1'000'001) / 1e6);
}

TEST(RadialLens, WithoutTermsChangesNothing) {
  const RadialLens lens;
  EXPECT_EQ(lens.distort(0.7), 0.7);
  EXPECT_EQ(lens.undistort(0.7), 0.7);
  EXPECT_EQ(lens.slope(0.7), 1.0);
}

TEST(RadialLens, FollowsBrownConrady) {
  const RadialLens lens(-0.2, 0.05);
  EXPECT_DOUBLE_EQ(lens.distort(0.5), 0.5 * (1.0 - 0.2 * 0.25 + 0.05 * 0.0625));
  EXPECT_NEAR(lens.undistort(lens.distort(0.5)), 0.5, 1e-14);
}

TEST(RadialLens, GoesOnWherePolynomialWouldTurnBack) {
  const RadialLens lens(-0.5, 0.0);  // turns back at sqrt(2/3)
  EXPECT_GT(lens.distort(2.0), lens.distort(1.0));
  EXPECT_EQ(lens.slope(2.0), RadialLens::kMinSlope);
  EXPECT_NEAR(lens.undistort(lens.distort(2.0)), 2.0, 1e-9);
  EXPECT_TRUE(std::isfinite(lens.undistort(100.0)));
}

RC_GTEST_PROP(RadialLens, RoundTripsForEveryLensAndDistance, ()) {
  const RadialLens lens(in_range(-5.0, 5.0), in_range(-5.0, 5.0));
  const double radius = in_range(0.0, 3.0);
  const double seen = lens.distort(radius);
  RC_ASSERT(std::abs(lens.distort(lens.undistort(seen)) - seen) <= 1e-12 * (1.0 + seen));
  RC_ASSERT(std::abs(lens.undistort(seen) - radius) <= 1e-9);
}

RC_GTEST_PROP(RadialLens, IsStrictlyIncreasing, ()) {
  const RadialLens lens(in_range(-5.0, 5.0), in_range(-5.0, 5.0));
  const double radius = in_range(0.0, 3.0);
  const double step = in_range(1e-3, 1.0);
  RC_ASSERT(lens.distort(radius + step) >=
            lens.distort(radius) + 0.999 * RadialLens::kMinSlope * step);
}

}  // namespace
}  // namespace maggic
