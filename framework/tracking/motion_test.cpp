/// Frames after frames: filters, identities and predictions.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/scorecard.hpp"
#include "tracking/angles.hpp"
#include "tracking/motion_filter.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

/// A robot that accelerates up to 5 m/s² and turns up to 15 rad/s, at random.
class Driver {
 public:
  Driver(Dice& dice, Pose start) : dice_(&dice), pose_(start) {}

  void drive(double dt_s) {
    if (--frames_left_ <= 0) {
      frames_left_ = 5 + dice_->below(25);
      acceleration_ = {dice_->uniform(-3500, 3500), dice_->uniform(-3500, 3500)};
      target_rate_ = dice_->uniform(-15, 15);
    }
    velocity_ += acceleration_ * dt_s;
    const double speed = std::hypot(velocity_.x, velocity_.y);
    if (speed > 1500) velocity_ *= 1500 / speed;
    pose_.position_mm += velocity_ * dt_s;
    bounce(pose_.position_mm.x, velocity_.x, 650);
    bounce(pose_.position_mm.y, velocity_.y, 550);
    // Wheels change the turning by some 100 rad/s² at most.
    rate_ += std::clamp(target_rate_ - rate_, -100 * dt_s, 100 * dt_s);
    pose_.heading_rad = wrap_turn(pose_.heading_rad + rate_ * dt_s);
  }

  const Pose& pose() const { return pose_; }
  cv::Point2d velocity() const { return velocity_; }

 private:
  static void bounce(double& position, double& velocity, double limit) {
    if (std::abs(position) < limit) return;
    position = std::copysign(limit, position);
    velocity = -velocity / 2;
  }

  Dice* dice_;
  Pose pose_;
  cv::Point2d velocity_;
  cv::Point2d acceleration_;
  double rate_ = 0.0;
  double target_rate_ = 0.0;
  int frames_left_ = 0;
};

TEST(FilterTest, FollowsHardDrivingWithoutLagAndDampsNoise) {
  Dice dice(1);
  const TrackingParameters defaults;
  for (const double noise_mm : {0.3, 0.8}) {
    Driver driver(dice, {{0, 0}, 0});
    PositionFilter position;
    HeadingFilter heading;
    ErrorDistribution position_error;
    ErrorDistribution heading_error;
    position.start({0, 0}, defaults.position_noise_mm, defaults.max_speed_mm_s);
    heading.start(0, radians(defaults.heading_noise_deg));
    for (int i = 0; i < 5000; ++i) {
      driver.drive(Camera::kFrameS);
      position.predict(Camera::kFrameS, defaults.acceleration_mm_s2);
      heading.predict(Camera::kFrameS, defaults.angular_acceleration_rad_s2);
      position.correct(
          driver.pose().position_mm + cv::Point2d(dice.normal(noise_mm), dice.normal(noise_mm)),
          defaults.position_noise_mm);
      heading.correct(driver.pose().heading_rad + dice.normal(radians(1.0)),
                      radians(defaults.heading_noise_deg));
      position_error.add(distance_mm(position.position_mm(), driver.pose().position_mm));
      heading_error.add(wrap_turn(heading.heading_rad() - driver.pose().heading_rad) * 180 / kPi);
    }
    // The noise itself is noise_mm·√2 in the plane; a lag would add to it.
    EXPECT_LT(position_error.rmse(), noise_mm * std::sqrt(2.0) * 1.05);
    EXPECT_LT(heading_error.rmse(), 1.05);
  }
}

TEST(FilterTest, StartsAtRestAndKnowsTheVelocityAtTheSecondSighting) {
  PositionFilter filter;
  filter.start({100, 0}, 0.8, 3000);
  EXPECT_EQ(filter.velocity_mm_s(), cv::Point2d());
  filter.predict(0.02, 6000);
  filter.correct({120, -10}, 0.8);
  EXPECT_NEAR(filter.velocity_mm_s().x, 1000, 30);
  EXPECT_NEAR(filter.velocity_mm_s().y, -500, 15);
}

TEST(FilterTest, UsesTheTimesFramesWereTaken) {
  PositionFilter filter;
  filter.start({0, 0}, 0.5, 3000);
  double x = 0;
  for (int i = 0; i < 200; ++i) {
    const double dt = i % 3 == 0 ? 0.05 : 0.01;
    x += 800 * dt;
    filter.predict(dt, 6000);
    filter.correct({x, 0}, 0.5);
  }
  EXPECT_NEAR(filter.velocity_mm_s().x, 800, 1);
}

TEST(FilterTest, HeadingGoesRoundWithoutAJump) {
  HeadingFilter filter;
  filter.start(3.0, 0.02);
  for (int i = 1; i <= 300; ++i) {
    filter.predict(0.01, 120);
    filter.correct(wrap_turn(3.0 + 0.1 * i), 0.02);
    if (i <= 5) continue;
    EXPECT_NEAR(wrap_turn(filter.heading_rad() - 3.0 - 0.1 * i), 0.0, 1e-2);
  }
  EXPECT_NEAR(filter.rate_rad_s(), 10.0, 0.1);
}

TEST(FilterTest, ACollisionIsFollowedAtOnce) {
  PositionFilter filter;
  filter.start({0, 0}, 0.8, 3000);
  double x = 0;
  for (int i = 0; i < 60; ++i) {
    filter.predict(1.0 / 60, 6000);
    filter.correct({x += 25, 0}, 0.8);
  }
  filter.predict(1.0 / 60, 6000);
  filter.correct({x -= 25, 0}, 0.8);
  EXPECT_NEAR(filter.position_mm().x, x, 0.5);
}

class MovingMatchTest : public ::testing::Test {
 protected:
  /// Drives robots of both teams with noisy centroids and scores what is reported.
  Scorecard play(const TagLayout& layout, int a_team, double noise_px, int frames) {
    Dice dice(7);
    std::vector<Driver> drivers;
    std::vector<std::pair<Team, int>> names;
    for (int i = 0; i < 2 * a_team; ++i) {
      drivers.emplace_back(dice, Pose{{-600.0 + 110.0 * i, -500.0 + 90.0 * i}, 1.0 * i});
      names.emplace_back(i < a_team ? Team::kBlue : Team::kYellow, i % a_team);
    }
    Camera camera({layout});
    Scene scene;
    Scorecard score;
    for (int frame = 0; frame < frames; ++frame) {
      scene.clear();
      Detections truth;
      for (std::size_t i = 0; i < drivers.size(); ++i) {
        Driver next = drivers[i];
        next.drive(Camera::kFrameS);
        // Robots do not drive into each other.
        bool is_free = true;
        for (std::size_t k = 0; k < drivers.size(); ++k) {
          is_free = is_free && (k == i || distance_mm(next.pose().position_mm,
                                                      drivers[k].pose().position_mm) > 107);
        }
        if (is_free) drivers[i] = next;
        const auto [team, id] = names[i];
        scene.add_robot(layout, color(team == Team::kBlue ? "blue" : "yellow"), id,
                        drivers[i].pose());
        RobotDetection real;
        real.team = team;
        real.id = id;
        real.position_mm = drivers[i].pose().position_mm;
        real.heading_rad = drivers[i].pose().heading_rad;
        truth.robots.push_back(real);
      }
      scene.shake(dice, noise_px);
      score.add(camera.look_at(scene), scene_of(truth), scene.field());
    }
    return score;
  }
};

TEST_F(MovingMatchTest, TwoTagRobotsKeepIdsAndPoses) {
  const Scorecard score = play(two_tags(), 3, 0.12, 600);
  const ObjectTally robots = score.robots();
  EXPECT_EQ(robots.right_identity, robots.frames);
  EXPECT_EQ(score.false_robots(), 0u);
  EXPECT_LT(robots.position_mm.rmse(), 0.8);
  EXPECT_LT(robots.heading_deg.rmse(), 1.5);
}

TEST_F(MovingMatchTest, ThreeTagRobotsKeepIdsAndPoses) {
  const Scorecard score = play(three_tags(), 5, 0.12, 600);
  const ObjectTally robots = score.robots();
  EXPECT_EQ(robots.right_identity, robots.frames);
  EXPECT_EQ(score.false_robots(), 0u);
  EXPECT_LT(robots.position_mm.rmse(), 0.8);
  EXPECT_LT(robots.heading_deg.rmse(), 1.5);
}

}  // namespace
}  // namespace maggic::tracking
