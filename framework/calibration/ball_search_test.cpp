#include "calibration/ball_search.hpp"

#include <gmock/gmock.h>

#include "calibration/tags_for_tests.hpp"

namespace maggic::calibration {
namespace {

using tags::label;
using tags::patch_at;

constexpr double kOrangeHue = 21.0;
constexpr double kRedHue = 252.0;
constexpr double kBallPx = 230.0;  // 42.7 mm at 2.5 mm a pixel, area

/// Frames in which a ball rolls over a field; more patches can be added to all of them.
class BallSearchTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kFrames = 5;

  BallSearchTest() : frames_(kFrames) {
    found_.resize(kFrames);
    naming_.frames.resize(kFrames);
    pattern_.ball_color = label("orange");
    pattern_.ball_diameter_mm = 42.7;
  }

  static cv::Point2d ball_at(std::size_t frame) {
    return {100.0 + 9.0 * static_cast<double>(frame), 200.0};
  }

  void roll_ball(double hue = kOrangeHue) {
    for (std::size_t f = 0; f < kFrames; ++f) {
      frames_[f].patches.push_back(patch_at(ball_at(f), kBallPx, hue, 190));
    }
  }
  void add(const Patch& patch) {
    for (FramePatches& frame : frames_) frame.patches.push_back(patch);
  }
  /// A patch that is known to be part of a robot.
  void add_named(const Patch& patch, Label name) {
    add(patch);
    for (std::size_t f = 0; f < kFrames; ++f) {
      found_[f].patches.push_back(patch);
      naming_.frames[f].label_of_patch.push_back(name);
    }
  }
  BallSightings find() const {
    return find_ball(frames_, found_, naming_, pattern_, Palette::standard(),
                     TagMetric::of_scale(2.5));
  }
  void expect_the_ball() const {
    const BallSightings ball = find();
    EXPECT_EQ(ball.count, static_cast<int>(kFrames));
    ASSERT_EQ(ball.by_frame.size(), kFrames);
    for (std::size_t f = 0; f < kFrames; ++f) {
      ASSERT_TRUE(ball.by_frame[f].has_value());
      EXPECT_EQ(ball.by_frame[f]->centroid_px, ball_at(f));
    }
  }

  std::vector<FramePatches> frames_;
  std::vector<FramePatches> found_;
  Naming naming_;
  TrackedPattern pattern_;
};

TEST_F(BallSearchTest, FindsWhatIsRoundAndOrangeInEveryFrame) {
  roll_ball();
  expect_the_ball();
}

TEST_F(BallSearchTest, ATagOfARobotIsNotTheBallHoweverMuchItLooksLikeIt) {
  for (std::size_t f = 0; f < kFrames; ++f) {  // blurred, so larger than a ball should be
    frames_[f].patches.push_back(patch_at(ball_at(f), 1.4 * kBallPx, kOrangeHue, 190));
  }
  add_named(patch_at({300, 100}, kBallPx, kOrangeHue, 190), label("red"));
  expect_the_ball();
}

TEST_F(BallSearchTest, ARedTagWhoseRobotWasNotReadIsNotTheBallEither) {
  roll_ball(8.0);
  add(patch_at({300, 100}, 200.0, kRedHue));
  expect_the_ball();
}

TEST_F(BallSearchTest, APaleBrownSquareOfTheVeryHueIsNotTheBall) {
  const Patch ball = patch_at({100, 200}, kBallPx, kOrangeHue + 9.0, 190);
  add(ball);
  add(patch_at({300, 100}, kBallPx, kOrangeHue, 45));
  for (const std::optional<Patch>& seen : find().by_frame) {
    ASSERT_TRUE(seen.has_value());
    EXPECT_EQ(seen->centroid_px, ball.centroid_px);
  }
}

TEST_F(BallSearchTest, WhatMovesIsRatherTheBallThanWhatNeverDoes) {
  roll_ball(kOrangeHue + 9.0);
  add(patch_at({300, 100}, kBallPx, kOrangeHue, 190));
  expect_the_ball();
}

TEST_F(BallSearchTest, WhatIsThereManyTimesIsNotTheBall) {
  roll_ball(12.0);
  for (int i = 0; i < 6; ++i) add(patch_at({300.0 + 30.0 * i, 100}, kBallPx, kOrangeHue, 190));
  expect_the_ball();
}

TEST_F(BallSearchTest, ThereIsNoneWhereNothingHasItsSizeShapeOrHue) {
  add(patch_at({50, 50}, 30.0, kOrangeHue));
  add(patch_at({90, 50}, 900.0, kOrangeHue));
  add(patch_at({150, 50}, kBallPx, 160.0));
  Patch rod = patch_at({200, 50}, kBallPx, kOrangeHue);
  rod.moments_px2 = {64.0, 0.0, 0.0, 8.0};
  add(rod);
  const BallSightings ball = find();
  EXPECT_EQ(ball.count, 0);
  EXPECT_THAT(ball.by_frame, ::testing::AllOf(::testing::SizeIs(kFrames),
                                              ::testing::Each(::testing::Eq(std::nullopt))));
}

TEST_F(BallSearchTest, FramesThatHideItHaveNone) {
  roll_ball();
  frames_[2].patches.clear();
  const BallSightings ball = find();
  EXPECT_EQ(ball.count, static_cast<int>(kFrames) - 1);
  EXPECT_FALSE(ball.by_frame[2].has_value());
}

}  // namespace
}  // namespace maggic::calibration
