/// Which blob is the ball, and where it is when it cannot be seen.

#include <gtest/gtest.h>

#include "maggic/scorecard.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

const Label kOrange = color("orange");

class BallTest : public ::testing::Test {
 protected:
  Scene scene_;
  Camera camera_{{two_tags()}};
};

TEST_F(BallTest, IsFoundAtTheHeightOfItsCentre) {
  scene_.add_ball({500, -300});
  const Detections& out = camera_.look_at(scene_);
  ASSERT_TRUE(out.ball);
  EXPECT_LT(distance_mm(out.ball->position_mm, {500, -300}), 0.01);
  EXPECT_EQ(out.ball->area_px, scene_.blobs()[0].area_px);
  EXPECT_LT(distance_mm(out.ball->centroid_px, scene_.blobs()[0].centroid_px), 1e-6);
  EXPECT_EQ(out.ball->state, TrackState::kSeen);
  EXPECT_GT(out.ball->confidence, 0.9);
  EXPECT_EQ(out.ball->velocity_mm_s, cv::Point2d());
}

TEST_F(BallTest, IsTheRoundBlobOfItsSize) {
  scene_.add(kOrange, {-300, 0}, 20, {300, 200}, 0, 60000);  // a shirt
  scene_.add(kOrange, {0, 200}, 20, {8, 8}, 0, 64);          // a speck
  scene_.add(kOrange, {200, 200}, 20, {90, 16}, 0.5, 1440);  // a cable
  EXPECT_FALSE(camera_.look_at(scene_).ball);
  scene_.add_ball({100, 100});
  const Detections& out = camera_.look_at(scene_);
  ASSERT_TRUE(out.ball);
  EXPECT_LT(distance_mm(out.ball->position_mm, {100, 100}), 0.01);
}

TEST_F(BallTest, IsNeverInsideARobot) {
  scene_.add_robot(two_tags(), color("blue"), 0, {{200, 100}, 0.7});
  scene_.add(kOrange, {215, 110}, 75, {33, 33}, 0.7, 1089);
  scene_.add(kOrange, {200, 133}, 75, {20, 20}, 0.7, 400);
  EXPECT_FALSE(camera_.look_at(scene_).ball);
}

TEST_F(BallTest, TouchingARobotIsStillTheBall) {
  scene_.add_robot(two_tags(), color("blue"), 0, {{200, 100}, 0.0});
  scene_.add_ball({200 + 37.5 + 21.4, 100});
  const Detections& out = camera_.look_at(scene_);
  ASSERT_TRUE(out.ball);
  EXPECT_EQ(out.robots.size(), 1u);
}

TEST_F(BallTest, PrefersWhatIsNearItsPath) {
  for (int i = 0; i < 10; ++i) {
    scene_.clear();
    scene_.add_ball({-300.0 + 10 * i, 0});
    camera_.look_at(scene_);
  }
  scene_.clear();
  scene_.add_ball({300, 200});  // somebody rolls a second one in
  scene_.add_ball({-200, 0}, kOrange, 36.0);
  const Detections& out = camera_.look_at(scene_);
  EXPECT_LT(distance_mm(out.ball->position_mm, {-200, 0}), 1.0);
}

TEST_F(BallTest, IsPredictedWhileHiddenAndForgottenAfterwards) {
  for (int i = 0; i < 10; ++i) {
    scene_.clear();
    scene_.add_ball({-300.0 + 10 * i, 0});
    camera_.look_at(scene_);
  }
  scene_.clear();
  double confidence = 1.0;
  for (int i = 10; i < 25; ++i) {
    const Detections& out = camera_.look_at(scene_);
    ASSERT_TRUE(out.ball);
    EXPECT_EQ(out.ball->state, TrackState::kPredicted);
    EXPECT_NEAR(out.ball->position_mm.x, -300.0 + 10 * i, 3.0);
    EXPECT_LT(out.ball->confidence, confidence);
    confidence = out.ball->confidence;
  }
  EXPECT_FALSE(camera_.look_at(scene_).ball);
}

TEST_F(BallTest, AFlashFarAwayIsIgnoredButANewPlaceIsBelievedAtTheSecondLook) {
  scene_.add_ball({-300, 0});
  for (int i = 0; i < 10; ++i) camera_.look_at(scene_);
  scene_.clear();
  scene_.add_ball({400, 300});
  EXPECT_LT(distance_mm(camera_.look_at(scene_).ball->position_mm, {-300, 0}), 1.0);
  const Detections& out = camera_.look_at(scene_);
  EXPECT_LT(distance_mm(out.ball->position_mm, {400, 300}), 1.0);
  EXPECT_EQ(out.ball->velocity_mm_s, cv::Point2d());
}

TEST_F(BallTest, KicksAndBouncesAreFollowedWithinTwoMillimetres) {
  Dice dice(3);
  cv::Point2d position(0, 0);
  cv::Point2d velocity(1400, 900);
  Scorecard score;
  for (int i = 0; i < 1500; ++i) {
    position += velocity * Camera::kFrameS;
    velocity *= 0.995;
    if (std::abs(position.x) > 720) velocity.x = -0.8 * std::copysign(velocity.x, position.x);
    if (std::abs(position.y) > 620) velocity.y = -0.8 * std::copysign(velocity.y, position.y);
    if (i % 70 == 69) velocity = {dice.uniform(-3000, 3000), dice.uniform(-3000, 3000)};
    scene_.clear();
    scene_.add_ball(position);
    scene_.shake(dice, 0.2);
    Detections truth;
    truth.ball.emplace().position_mm = position;
    score.add(camera_.look_at(scene_), scene_of(truth), scene_.field());
  }
  EXPECT_EQ(score.ball().seen, score.ball().frames);
  EXPECT_LT(score.ball().position_mm.rmse(), 1.0);
}

}  // namespace
}  // namespace maggic::tracking
