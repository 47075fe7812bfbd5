#include "maggic/truth_score.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace maggic {
namespace {

RobotDetection robot(Team team, int id, cv::Point2d position_mm, double heading_rad = 0.0) {
  RobotDetection detection;
  detection.team = team;
  detection.id = id;
  detection.position_mm = position_mm;
  detection.heading_rad = heading_rad;
  return detection;
}

Detections frame(std::vector<RobotDetection> robots) {
  Detections detections;
  detections.robots = std::move(robots);
  return detections;
}

BallDetection ball_at(cv::Point2d position_mm) {
  BallDetection ball;
  ball.position_mm = position_mm;
  return ball;
}

TEST(ErrorSumTest, KeepsRootOfMeanSquareAndMaximum) {
  ErrorSum sum;
  EXPECT_EQ(sum.rmse(), 0.0);
  sum.add(3.0);
  sum.add(-4.0);
  EXPECT_DOUBLE_EQ(sum.rmse(), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(sum.max, 4.0);
  EXPECT_EQ(sum.count, 2u);
}

TEST(TruthScoreTest, CountsRobotsFoundMissedAndFalse) {
  TruthScore score(50.0);
  const Detections truth = frame({robot(Team::kBlue, 0, {0, 0}), robot(Team::kBlue, 1, {500, 0})});
  const Detections found =
      frame({robot(Team::kBlue, 0, {3, 4}), robot(Team::kYellow, 2, {-300, 100})});
  score.add(found, truth);
  EXPECT_EQ(score.frames, 1u);
  EXPECT_EQ(score.robots_true, 2u);
  EXPECT_EQ(score.robots_found, 1u);
  EXPECT_EQ(score.robots_right_id, 1u);
  EXPECT_EQ(score.robots_false, 1u);
  EXPECT_DOUBLE_EQ(score.robot_position_mm.rmse(), 5.0);
}

TEST(TruthScoreTest, AWrongIdOrTeamIsFoundButNotRight) {
  TruthScore score;
  score.add(frame({robot(Team::kBlue, 1, {0, 0}), robot(Team::kYellow, 2, {200, 0})}),
            frame({robot(Team::kBlue, 0, {0, 0}), robot(Team::kBlue, 2, {200, 0})}));
  EXPECT_EQ(score.robots_found, 2u);
  EXPECT_EQ(score.robots_right_id, 0u);
  EXPECT_EQ(score.robots_false, 0u);
}

TEST(TruthScoreTest, MatchesAsManyAsPossibleRatherThanNearestFirst) {
  // Nearest first would pair the middle ones (10 mm) and leave two pairs 50 mm and more apart.
  TruthScore score(50.0);
  score.add(frame({robot(Team::kBlue, 0, {40, 0}), robot(Team::kBlue, 1, {90, 0})}),
            frame({robot(Team::kBlue, 0, {0, 0}), robot(Team::kBlue, 1, {50, 0})}));
  EXPECT_EQ(score.robots_found, 2u);
  EXPECT_EQ(score.robots_right_id, 2u);
  EXPECT_DOUBLE_EQ(score.robot_position_mm.max, 40.0);
}

TEST(TruthScoreTest, HeadingsAreComparedAcrossTheWrap) {
  TruthScore score;
  const double almost = std::numbers::pi - std::numbers::pi / 180.0;
  score.add(frame({robot(Team::kBlue, 0, {0, 0}, almost)}),
            frame({robot(Team::kBlue, 0, {0, 0}, -almost)}));
  EXPECT_NEAR(score.robot_heading_deg.rmse(), 2.0, 1e-9);
}

TEST(TruthScoreTest, CountsTheBall) {
  TruthScore score(50.0);
  Detections with = frame({});
  with.ball = ball_at({10, 0});
  Detections near = frame({});
  near.ball = ball_at({13, 4});
  Detections far = frame({});
  far.ball = ball_at({100, 0});
  const Detections without = frame({});
  score.add(near, with);
  score.add(far, with);
  score.add(without, with);
  score.add(near, without);
  EXPECT_EQ(score.balls_true, 3u);
  EXPECT_EQ(score.balls_found, 1u);
  EXPECT_EQ(score.balls_false, 2u);
  EXPECT_DOUBLE_EQ(score.ball_position_mm.rmse(), 5.0);
}

}  // namespace
}  // namespace maggic
