#include "tracking/pose.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tracking/angles.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

RC_GTEST_PROP(FitPoseTest, FindsTheMotionThatMovedThePoints, ()) {
  Dice dice(*rc::gen::arbitrary<std::uint32_t>());
  const Pose truth{{dice.uniform(-900, 900), dice.uniform(-900, 900)}, dice.uniform(-kPi, kPi)};
  std::array<PointPair, 4> pairs;
  for (PointPair& pair : pairs) {
    pair.robot_mm = {dice.uniform(-40, 40), dice.uniform(-40, 40)};
    pair.field_mm = truth.apply(pair.robot_mm);
    pair.weight = dice.uniform(0.1, 2.0);
  }
  const Pose found = fit_pose(pairs);
  RC_ASSERT(distance_mm(found.position_mm, truth.position_mm) < 1e-6);
  RC_ASSERT(std::abs(wrap_turn(found.heading_rad - truth.heading_rad)) < 1e-8);
}

RC_GTEST_PROP(FitPoseTest, NoSmallMoveFitsNoisyPointsBetter, ()) {
  Dice dice(*rc::gen::arbitrary<std::uint32_t>());
  std::array<PointPair, 3> pairs;
  const std::array<cv::Point2d, 3> pattern{{{-17.5, 0}, {17.5, -17.5}, {17.5, 17.5}}};
  for (std::size_t i = 0; i < 3; ++i) {
    pairs[i] = {pattern[i], pattern[i] + cv::Point2d(dice.normal(3), dice.normal(3)), 1.0};
  }
  const auto squares = [&](const Pose& pose) {
    double sum = 0.0;
    for (const PointPair& pair : pairs) {
      sum += std::pow(distance_mm(pose.apply(pair.robot_mm), pair.field_mm), 2);
    }
    return sum;
  };
  const Pose best = fit_pose(pairs);
  const Pose other{best.position_mm + cv::Point2d(dice.normal(1), dice.normal(1)),
                   best.heading_rad + dice.normal(0.05)};
  RC_ASSERT(squares(best) <= squares(other) + 1e-9);
}

TEST(PoseTest, RobotFrameHasXToTheFrontAndYToTheLeft) {
  const Pose pose{{100, 50}, kPi / 2};
  EXPECT_NEAR(distance_mm(pose.apply({10, 0}), {100, 60}), 0.0, 1e-12);
  EXPECT_NEAR(distance_mm(pose.apply({0, 10}), {90, 50}), 0.0, 1e-12);
  EXPECT_NEAR(distance_mm(pose.to_robot({90, 50}), {0, 10}), 0.0, 1e-12);
}

TEST(WrapTest, TurnsAreInTheHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrap_turn(3 * kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_turn(-kPi), kPi);
  EXPECT_NEAR(wrap_turn(2 * kPi + 0.25), 0.25, 1e-12);
  EXPECT_NEAR(wrap_line(kPi - 0.25), -0.25, 1e-12);
}

}  // namespace
}  // namespace maggic::tracking
