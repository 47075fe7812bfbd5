#include "maggic/scorecard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "maggic/score_figures.hpp"

namespace maggic {
namespace {

/// A camera that looks straight down at the floor: 0.34 px a mm, centre at (319.5, 239.5).
const Field& field() {
  static const Field straight_down = [] {
    FieldParameters parameters;
    parameters.corners_px = {{64.5, 18.5}, {574.5, 18.5}, {574.5, 460.5}, {64.5, 460.5}};
    parameters.robot_height_mm = 0.0;
    parameters.ball_height_mm = 0.0;
    return Field(parameters, {640, 480});
  }();
  return straight_down;
}

cv::Point2d px(cv::Point2d position_mm) { return field().to_image_px(position_mm, 0.0); }

RobotDetection found(Team team, int id, cv::Point2d position_mm, double heading_rad = 0.0) {
  RobotDetection robot;
  robot.team = team;
  robot.id = id;
  robot.position_mm = position_mm;
  robot.centroid_px = px(position_mm);
  robot.heading_rad = heading_rad;
  return robot;
}

TrueRobot real(Team team, int id, cv::Point2d position_mm, double heading_rad = 0.0) {
  TrueRobot robot;
  robot.identity.team = team;
  robot.identity.id = id;
  robot.position_mm = position_mm;
  robot.heading_rad = heading_rad;
  return robot;
}

Detections frame_of(std::vector<RobotDetection> robots) {
  Detections detections;
  detections.robots = std::move(robots);
  return detections;
}

TrueScene scene_of(std::vector<TrueRobot> robots) {
  TrueScene scene;
  scene.robots = std::move(robots);
  return scene;
}

Detections with_ball(cv::Point2d position_mm, TrackState state = TrackState::kSeen) {
  Detections detections;
  detections.ball.emplace();
  detections.ball->position_mm = position_mm;
  detections.ball->centroid_px = px(position_mm);
  detections.ball->state = state;
  return detections;
}

TrueScene ball_scene(cv::Point2d position_mm) {
  TrueScene scene;
  scene.ball = TrueBall{std::nullopt, position_mm};
  return scene;
}

constexpr Tolerance kTwentyMm{20.0, Tolerance::Unit::kMillimeters};

TEST(ScorecardTest, CountsRobotsSeenMissedAndFalse) {
  Scorecard card(kTwentyMm);
  card.add(frame_of({found(Team::kBlue, 0, {3, 4}), found(Team::kYellow, 2, {-300, 100})}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {500, 0})}), field());
  const ObjectTally robots = card.robots();
  EXPECT_EQ(card.frames(), 1u);
  EXPECT_EQ(robots.frames, 2u);
  EXPECT_EQ(robots.seen, 1u);
  EXPECT_EQ(robots.missed(), 1u);
  EXPECT_EQ(robots.right_identity, 1u);
  EXPECT_EQ(card.false_robots(), 1u);
  EXPECT_EQ(card.frames_right(), 0u);
  EXPECT_DOUBLE_EQ(robots.position_mm.rmse(), 5.0);
  EXPECT_NEAR(robots.position_px.rmse(), 5.0 * 0.34, 1e-6);
}

TEST(ScorecardTest, KeepsEachRobotApart) {
  Scorecard card(kTwentyMm);
  const auto truth = scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kYellow, 0, {500, 0})});
  card.add(frame_of({found(Team::kBlue, 0, {0, 0})}), truth, field());
  card.add(frame_of({found(Team::kBlue, 0, {0, 0}), found(Team::kYellow, 0, {500, 8})}), truth,
           field());
  ASSERT_EQ(card.each_robot().size(), 2u);
  EXPECT_EQ(card.each_robot()[0].tally.seen, 2u);
  EXPECT_EQ(card.each_robot()[1].tally.seen, 1u);
  EXPECT_EQ(card.each_robot()[1].tally.missed(), 1u);
  EXPECT_DOUBLE_EQ(card.each_robot()[1].tally.position_mm.max(), 8.0);
  EXPECT_EQ(card.frames_right(), 1u);
}

TEST(ScorecardTest, AWrongIdOrTeamIsSeenButNotRight) {
  Scorecard card(kTwentyMm);
  card.add(frame_of({found(Team::kBlue, 1, {0, 0}), found(Team::kYellow, 2, {200, 0}),
                     found(Team::kBlue, kUnknownId, {400, 0})}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 2, {200, 0}),
                     real(Team::kBlue, 3, {400, 0})}),
           field());
  const ObjectTally robots = card.robots();
  EXPECT_EQ(robots.seen, 3u);
  EXPECT_EQ(robots.right_identity, 0u);
  EXPECT_EQ(robots.wrong_identity, 2u);
  EXPECT_EQ(robots.unknown_identity, 1u);
  EXPECT_EQ(card.false_robots(), 0u);
}

TEST(ScorecardTest, ComparesColoursWhereNoIdIsKnown) {
  const Palette palette = Palette::standard();
  TrueRobot truth = real(Team::kBlue, 0, {0, 0});
  truth.identity.id.reset();
  truth.identity.player_colors = {*palette.find("red"), *palette.find("green")};
  RobotDetection robot = found(Team::kBlue, 7, {0, 0});
  robot.player_colors = truth.identity.player_colors;
  Scorecard card(kTwentyMm);
  card.add(frame_of({robot}), scene_of({truth}), field());
  std::swap(robot.player_colors[0], robot.player_colors[1]);
  card.add(frame_of({robot}), scene_of({truth}), field());
  robot.player_colors.clear();
  card.add(frame_of({robot}), scene_of({truth}), field());
  EXPECT_EQ(card.robots().right_identity, 1u);
  EXPECT_EQ(card.robots().wrong_identity, 1u);
  EXPECT_EQ(card.robots().unknown_identity, 1u);
}

TEST(ScorecardTest, ABiasedPositionIsOffRatherThanMissedAndFalse) {
  Scorecard card({10.0, Tolerance::Unit::kMillimeters});
  card.add(frame_of({found(Team::kBlue, 0, {30, 0})}), scene_of({real(Team::kBlue, 0, {0, 0})}),
           field());
  EXPECT_EQ(card.robots().seen, 1u);
  EXPECT_EQ(card.robots().within_tolerance, 0u);
  EXPECT_EQ(card.false_robots(), 0u);
  EXPECT_EQ(card.frames_right(), 0u);
}

TEST(ScorecardTest, ATruthInPixelsIsMatchedInPixels) {
  Scorecard card({2.0, Tolerance::Unit::kPixels});
  TrueRobot truth = real(Team::kBlue, 0, {});
  truth.position_mm.reset();
  truth.centroid_px = px({100, 100});
  RobotDetection robot = found(Team::kBlue, 0, {100, 100});
  robot.centroid_px += cv::Point2d(1.5, 0.0);
  robot.position_mm = {900, 900};  // a calibration gone wrong does not make it another robot
  card.add(frame_of({robot}), scene_of({truth}), field());
  EXPECT_EQ(card.robots().within_tolerance, 1u);
  EXPECT_DOUBLE_EQ(card.robots().position_px.rmse(), 1.5);
  EXPECT_NEAR(card.robots().position_mm.rmse(), std::hypot(800.0, 800.0), 1e-6);
}

TEST(ScorecardTest, MatchesAsManyAsPossibleRatherThanNearestFirst) {
  // Nearest first would pair the middle ones (10 mm) and leave two pairs farther apart than the
  // gate.
  Scorecard card(kTwentyMm);
  card.add(frame_of({found(Team::kBlue, 0, {40, 0}), found(Team::kBlue, 1, {90, 0})}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {50, 0})}), field());
  EXPECT_EQ(card.robots().seen, 2u);
  EXPECT_EQ(card.robots().right_identity, 2u);
  EXPECT_DOUBLE_EQ(card.robots().position_mm.max(), 40.0);
}

TEST(ScorecardTest, APredictedRobotIsNeitherSeenNorFalse) {
  RobotDetection near = found(Team::kBlue, 0, {5, 0});
  near.state = TrackState::kPredicted;
  RobotDetection astray = found(Team::kBlue, 1, {-600, 0});
  astray.state = TrackState::kPredicted;
  Scorecard card(kTwentyMm);
  card.add(frame_of({near, astray}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {600, 0})}), field());
  EXPECT_EQ(card.robots().seen, 0u);
  EXPECT_EQ(card.robots().predicted, 1u);
  EXPECT_EQ(card.robots().missed(), 1u);
  EXPECT_EQ(card.false_robots(), 0u);
  EXPECT_EQ(card.robots().position_mm.count(), 0u);
}

TEST(ScorecardTest, APredictionDoesNotTakeTheTruthFromWhatIsSeen) {
  RobotDetection prediction = found(Team::kBlue, 1, {0, 0});
  prediction.state = TrackState::kPredicted;
  Scorecard card(kTwentyMm);
  card.add(frame_of({prediction, found(Team::kBlue, 0, {15, 0})}),
           scene_of({real(Team::kBlue, 0, {0, 0})}), field());
  EXPECT_EQ(card.robots().seen, 1u);
  EXPECT_EQ(card.robots().right_identity, 1u);
}

TEST(ScorecardTest, HeadingsAreComparedAcrossTheWrap) {
  Scorecard card(kTwentyMm);
  const double almost = std::numbers::pi - std::numbers::pi / 180.0;
  card.add(frame_of({found(Team::kBlue, 0, {0, 0}, almost)}),
           scene_of({real(Team::kBlue, 0, {0, 0}, -almost)}), field());
  EXPECT_NEAR(card.robots().heading_deg.rmse(), 2.0, 1e-9);
}

TEST(ScorecardTest, AHeadingInAStretchedPictureIsTurnedIntoTheFields) {
  FieldParameters parameters;
  parameters.corners_px = {{0, 0}, {1500, 0}, {1500, 650}, {0, 650}};  // half as high as it is
  const Field stretched(parameters, {1501, 651});
  TrueRobot truth = real(Team::kBlue, 0, {0, 0});
  truth.heading_rad.reset();
  truth.picture_heading_rad = std::atan2(0.5, 1.0);
  const double height_mm = stretched.robot_height_mm();
  RobotDetection robot = found(Team::kBlue, 0, {0, 0}, std::numbers::pi / 4.0);
  robot.centroid_px = stretched.to_image_px({0, 0}, height_mm);
  Scorecard card(kTwentyMm);
  card.add(frame_of({robot}), scene_of({truth}), stretched);
  EXPECT_NEAR(card.robots().heading_deg.max(), 0.0, 1e-6);
}

TEST(ScorecardTest, ASwapCountsOnceHoweverLongItLasts) {
  const auto truth = scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {200, 0})});
  const auto right = frame_of({found(Team::kBlue, 0, {0, 0}), found(Team::kBlue, 1, {200, 0})});
  const auto swapped = frame_of({found(Team::kBlue, 1, {0, 0}), found(Team::kBlue, 0, {200, 0})});
  const auto one_gone = frame_of({found(Team::kBlue, 1, {0, 0})});
  Scorecard card(kTwentyMm);
  for (const Detections& frame : {right, swapped, swapped, one_gone, swapped, right, swapped}) {
    card.add(frame, truth, field());
  }
  EXPECT_EQ(card.swaps(), 2u);
  EXPECT_EQ(card.robots().exchanged, 8u);
  EXPECT_EQ(card.robots().wrong_identity, 9u);
}

TEST(ScorecardTest, OneWrongIdIsNoSwap) {
  Scorecard card(kTwentyMm);
  card.add(frame_of({found(Team::kBlue, 1, {0, 0}), found(Team::kBlue, 2, {200, 0})}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {200, 0})}), field());
  EXPECT_EQ(card.swaps(), 0u);
  EXPECT_EQ(card.robots().wrong_identity, 2u);
}

TEST(ScorecardTest, CountsTheBall) {
  Scorecard card(kTwentyMm);
  card.add(with_ball({13, 4}), ball_scene({10, 0}), field());
  card.add(with_ball({30, 0}), ball_scene({0, 0}), field());
  card.add(with_ball({400, 0}), ball_scene({0, 0}), field());
  card.add(Detections(), ball_scene({0, 0}), field());
  card.add(with_ball({0, 0}, TrackState::kPredicted), ball_scene({0, 0}), field());
  card.add(with_ball({0, 0}), TrueScene(), field());
  card.add(with_ball({0, 0}, TrackState::kPredicted), TrueScene(), field());
  EXPECT_EQ(card.ball().frames, 5u);
  EXPECT_EQ(card.ball().seen, 2u);
  EXPECT_EQ(card.ball().within_tolerance, 1u);
  EXPECT_EQ(card.ball().predicted, 1u);
  EXPECT_EQ(card.ball().missed(), 2u);
  EXPECT_EQ(card.false_balls(), 2u);
  EXPECT_DOUBLE_EQ(card.ball().position_mm.max(), 30.0);
  EXPECT_EQ(card.frames_right(), 2u) << "the first and the last";
}

TEST(ScorecardTest, JitterIsMeasuredOnRobotsThatStandStill) {
  Scorecard card(kTwentyMm);
  for (int i = 0; i < 10; ++i) {
    const double moved = 10.0 * i;
    const double shake = i % 2 == 0 ? 1.0 : -1.0;
    card.add(frame_of({found(Team::kBlue, 0, {shake, 0}), found(Team::kBlue, 1, {300 + moved, 0})}),
             scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 1, {300 + moved, 0})}),
             field());
  }
  EXPECT_NEAR(card.robots().jitter_mm.deviation().value(), std::sqrt(10.0 / 9.0), 1e-9);
  EXPECT_FALSE(card.each_robot()[1].tally.jitter_mm.deviation());
}

TEST(ScorecardTest, SurvivesTheSameRobotTwiceInTheTruth) {
  Scorecard card(kTwentyMm);
  card.add(frame_of({found(Team::kBlue, 0, {0, 0}), found(Team::kBlue, 0, {300, 0})}),
           scene_of({real(Team::kBlue, 0, {0, 0}), real(Team::kBlue, 0, {300, 0})}), field());
  ASSERT_EQ(card.each_robot().size(), 1u);
  EXPECT_EQ(card.robots().seen, 2u);
}

/// Robots on a grid wide enough that none can be mistaken for its neighbour, moved a little.
TrueScene random_scene() {
  const int count = *rc::gen::inRange(0, 8);
  TrueScene scene;
  for (int i = 0; i < count; ++i) {
    const cv::Point2d shift(*rc::gen::inRange(-20, 21), *rc::gen::inRange(-20, 21));
    scene.robots.push_back(real(i % 2 == 0 ? Team::kBlue : Team::kYellow, i / 2,
                                cv::Point2d(-600.0 + 170.0 * i, 90.0 * i - 300.0) + shift,
                                0.1 * *rc::gen::inRange(-31, 32)));
  }
  if (*rc::gen::arbitrary<bool>()) scene.ball = TrueBall{std::nullopt, cv::Point2d(650, -500)};
  return scene;
}

Detections seen_in(const TrueScene& scene) {
  Detections detections;
  for (const TrueRobot& robot : scene.robots) {
    detections.robots.push_back(
        found(robot.identity.team, *robot.identity.id, *robot.position_mm, *robot.heading_rad));
  }
  if (scene.ball) detections.ball = with_ball(*scene.ball->position_mm).ball;
  return detections;
}

RC_GTEST_PROP(ScorecardProperty, DetectionsThatAreTheTruthAreRightInEveryFigure, ()) {
  const TrueScene scene = random_scene();
  Scorecard card(kTwentyMm);
  for (int i = 0; i < 6; ++i) card.add(seen_in(scene), scene, field());
  RC_ASSERT(card.frames_right() == card.frames());
  for (const Figure& figure : score_figures(card, StepStatistics(), std::nullopt)) {
    if (!figure.value) continue;
    const double best = figure.better == Better::kHigher ? 100.0 : 0.0;
    RC_ASSERT(std::abs(*figure.value - best) < 1e-3);
  }
}

RC_GTEST_PROP(ScorecardProperty, TheOrderOfRobotsDoesNotMatter, ()) {
  Scorecard card(kTwentyMm);
  Scorecard shuffled_card(kTwentyMm);
  for (int frame = 0; frame < 3; ++frame) {
    TrueScene scene = random_scene();
    Detections detections = seen_in(scene);
    for (RobotDetection& robot : detections.robots) {
      robot.position_mm += cv::Point2d(*rc::gen::inRange(-60, 61), *rc::gen::inRange(-60, 61));
      robot.centroid_px = px(robot.position_mm);
      robot.id = *rc::gen::inRange(-1, 4);
      if (*rc::gen::inRange(0, 4) == 0) robot.state = TrackState::kPredicted;
    }
    card.add(detections, scene, field());
    std::ranges::reverse(detections.robots);
    if (!scene.robots.empty()) std::swap(scene.robots.front(), scene.robots.back());
    shuffled_card.add(detections, scene, field());
  }
  const auto figures = score_figures(card, StepStatistics(), std::nullopt);
  const auto shuffled = score_figures(shuffled_card, StepStatistics(), std::nullopt);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    RC_ASSERT(figures[i].value.has_value() == shuffled[i].value.has_value());
    if (figures[i].value) RC_ASSERT(std::abs(*figures[i].value - *shuffled[i].value) < 1e-9);
  }
}

}  // namespace
}  // namespace maggic
