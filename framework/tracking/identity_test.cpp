/// Who a robot is when its tags are missed, wrong, merged or doubled.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracking/angles.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

const Label kBlue = color("blue");
const Label kYellow = color("yellow");

/// One robot that drives a curve; its patches can be taken away or recoloured.
class IdentityTest : public ::testing::Test {
 protected:
  static Pose pose_at(int frame) {
    return {{-300.0 + 10.0 * frame, 3.0 * frame}, 0.4 + 0.05 * frame};
  }

  /// Blob 0 is the team patch, the others the player patches.
  Scene& scene_at(int frame, const TagLayout& layout, int id) {
    scene_.clear();
    scene_.add_robot(layout, kBlue, id, pose_at(frame));
    return scene_;
  }

  void warm_up(Camera& camera, const TagLayout& layout, int id, int frames = 10) {
    for (; frame_ < frames; ++frame_) camera.look_at(scene_at(frame_, layout, id));
  }

  void expect_followed(const Detections& out, int id, double mm, double deg) {
    ASSERT_EQ(out.robots.size(), 1u);
    EXPECT_EQ(out.robots[0].id, id);
    EXPECT_EQ(out.robots[0].state, TrackState::kSeen);
    EXPECT_LT(distance_mm(out.robots[0].position_mm, pose_at(frame_).position_mm), mm);
    EXPECT_NEAR(wrap_turn(out.robots[0].heading_rad - pose_at(frame_).heading_rad), 0.0,
                radians(deg));
  }

  Scene scene_;
  int frame_ = 0;
};

TEST_F(IdentityTest, AMissedPlayerTagCostsConfidenceButNotTheId) {
  Camera camera({two_tags()});
  warm_up(camera, two_tags(), 2);
  for (int missed = 0; missed < 6; ++missed, ++frame_) {
    Scene& scene = scene_at(frame_, two_tags(), 2);
    scene.blobs().erase(scene.blobs().begin() + 1);
    const Detections& out = camera.look_at(scene);
    expect_followed(out, 2, 2.0, 3.0);
    EXPECT_LT(out.robots[0].confidence, 0.7);
    EXPECT_TRUE(out.robots[0].player_colors.empty());
    EXPECT_EQ(out.robots[0].tags.size(), 1u);
  }
}

TEST_F(IdentityTest, ATeamTagAloneKeepsTheSideARobotFacesThroughWholeTurns) {
  Camera camera({two_tags()});
  const auto turned = [&] { return Pose{{-200, 80}, 0.4 + 0.1 * frame_}; };
  for (; frame_ < 10; ++frame_) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 2, turned());
    camera.look_at(scene_);
  }
  for (int missed = 0; missed < 150; ++missed, ++frame_) {
    scene_.clear();
    scene_.add_patch(two_tags().patches[0], kBlue, turned());
    const Detections& out = camera.look_at(scene_);
    ASSERT_EQ(out.robots.size(), 1u);
    ASSERT_EQ(out.robots[0].id, 2);
    ASSERT_NEAR(wrap_turn(out.robots[0].heading_rad - turned().heading_rad), 0.0, radians(5));
  }
}

TEST_F(IdentityTest, ATeamColorThatSwallowsThePlayerTagCostsTheHeadingNotThePlace) {
  for (const TagLayout& layout : {two_tags(), three_tags()}) {
    Camera camera({layout});
    Dice dice(5);
    const auto look = [&](int frame, bool swallowed) {
      scene_.clear();
      scene_.add_robot(layout, kBlue, 2, {{-100, 50}, 0.4 + 0.12 * std::min(frame, 10)});
      if (swallowed) {
        while (scene_.blobs().size() > 1) scene_.merge(0, 1);
      }
      scene_.shake(dice, 0.05);
      return camera.look_at(scene_);
    };
    for (int i = 0; i < 10; ++i) look(i, false);
    Detections out;
    for (int i = 10; i < 100; ++i) {
      out = look(i, true);
      ASSERT_EQ(out.robots.size(), 1u);
      ASSERT_EQ(out.robots[0].id, 2);
      ASSERT_LT(distance_mm(out.robots[0].position_mm, {-100, 50}), 2.0);
      // It turned at 7 rad/s when last seen well; nothing says that it still does.
      ASSERT_LT(std::abs(wrap_turn(out.robots[0].heading_rad - 1.6)), radians(60));
    }
    EXPECT_LE(out.robots[0].confidence, 0.3);
    out = look(100, false);
    ASSERT_EQ(out.robots.size(), 1u);
    EXPECT_EQ(out.robots[0].id, 2);
    EXPECT_NEAR(wrap_turn(out.robots[0].heading_rad - 1.6), 0.0, radians(3));
    EXPECT_LT(distance_mm(out.robots[0].position_mm, {-100, 50}), 1.0);
    EXPECT_LT(std::abs(out.robots[0].angular_velocity_rad_s), 1.0);
    EXPECT_GT(out.robots[0].confidence, 0.8);
  }
}

TEST_F(IdentityTest, AFullViewPutsATurnedHeadingRightAtOnce) {
  Camera camera({two_tags()});
  const auto look = [&](double heading_rad, bool whole) -> const Detections& {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 1, {{-17.5 * (1 - std::cos(heading_rad)), 0}, heading_rad});
    if (!whole) scene_.blobs().erase(scene_.blobs().begin() + 1);
    return camera.look_at(scene_);
  };
  for (int i = 0; i < 10; ++i) look(0.0, true);
  for (int i = 0; i < 5; ++i) look(0.0, false);
  // Turned about by hand while hidden; what is left to see lies as it did.
  for (int i = 0; i < 5; ++i) look(kPi, false);
  scene_.clear();
  scene_.add_robot(two_tags(), kBlue, 1, {{-35, 0}, kPi});
  const Detections& out = camera.look_at(scene_);
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].id, 1);
  EXPECT_NEAR(wrap_turn(out.robots[0].heading_rad - kPi), 0.0, radians(1));
  EXPECT_LT(distance_mm(out.robots[0].position_mm, {-35, 0}), 0.1);
  EXPECT_EQ(out.robots[0].velocity_mm_s, cv::Point2d());
}

TEST_F(IdentityTest, AMissedTeamTagIsBridgedByThePlayerTags) {
  for (const TagLayout& layout : {two_tags(), three_tags()}) {
    frame_ = 0;
    Camera camera({layout});
    warm_up(camera, layout, 3);
    Scene& scene = scene_at(frame_, layout, 3);
    scene.blobs().erase(scene.blobs().begin());
    expect_followed(camera.look_at(scene), 3, 2.0, 3.0);
  }
}

TEST_F(IdentityTest, OneOfTwoPlayerTagsIsEnoughToFollow) {
  Camera camera({two_tags(), three_tags()});
  warm_up(camera, three_tags(), 7);
  Scene& scene = scene_at(frame_, three_tags(), 7);
  scene.blobs().erase(scene.blobs().begin() + 2);
  expect_followed(camera.look_at(scene), 7, 2.0, 3.0);
}

TEST_F(IdentityTest, WrongColorsForAFewFramesChangeNothing) {
  Camera camera({two_tags()});
  warm_up(camera, two_tags(), 0);
  for (const std::string_view wrong : {"green", "brown", "green", "green", "magenta"}) {
    Scene& scene = scene_at(frame_, two_tags(), 0);
    scene.blobs()[1].label = color(wrong);
    expect_followed(camera.look_at(scene), 0, 1.0, 2.0);
    ++frame_;
  }
}

TEST_F(IdentityTest, ColorsThatStayDifferentChangeTheId) {
  Camera camera({two_tags()});
  warm_up(camera, two_tags(), 0);
  int held = 0;
  while (camera.look_at(scene_at(frame_, two_tags(), 1)).robots.at(0).id == 0) {
    ++held;
    ++frame_;
    ASSERT_LT(held, 20);
  }
  EXPECT_GE(held, 3);
  expect_followed(camera.look_at(scene_at(++frame_, two_tags(), 1)), 1, 1.0, 2.0);
}

TEST_F(IdentityTest, TwoIdsThatWereSwappedAreSwappedBack) {
  Camera camera({two_tags()});
  const auto look = [&](int left_id, int right_id) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, left_id, {{-100, 0}, 1.0});
    scene_.add_robot(two_tags(), kBlue, right_id, {{100, 0}, 2.0});
    return camera.look_at(scene_);
  };
  for (int i = 0; i < 10; ++i) look(0, 1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(look(1, 0).robots.size(), 2u);
  const Detections out = look(1, 0);
  EXPECT_LT(distance_mm(robot_of(out, Team::kBlue, 1)->position_mm, {-100, 0}), 0.1);
  EXPECT_LT(distance_mm(robot_of(out, Team::kBlue, 0)->position_mm, {100, 0}), 0.1);
}

TEST_F(IdentityTest, ARobotThatLooksLikeATeamMateKeepsItsOwnIdByMotion) {
  Camera camera({two_tags()});
  const auto look = [&](std::string_view second) -> const Detections& {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 0, {{-100, 0}, 1.0});
    scene_.add_colored_robot(two_tags(), kBlue, {color(second)}, {{100, 0}, 2.0});
    return camera.look_at(scene_);
  };
  for (int i = 0; i < 10; ++i) look("green");
  for (int i = 0; i < 4; ++i) {
    const Detections& out = look("red");
    ASSERT_EQ(out.robots.size(), 2u);
    ASSERT_NE(robot_of(out, Team::kBlue, 0), nullptr);
    EXPECT_LT(distance_mm(robot_of(out, Team::kBlue, 0)->position_mm, {-100, 0}), 0.1);
    ASSERT_NE(robot_of(out, Team::kBlue, 1), nullptr);
  }
}

TEST_F(IdentityTest, UnseenRobotsArePredictedWithFallingConfidenceThenForgotten) {
  TrackingParameters parameters = standard_parameters();
  parameters.predict_frames = 6;
  Camera camera({two_tags()}, parameters);
  for (; frame_ < 10; ++frame_) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 2, {{-300.0 + 10.0 * frame_, 50}, 1.0});
    camera.look_at(scene_);
  }
  scene_.clear();
  double confidence = 1.0;
  for (int missed = 1; missed <= 6; ++missed, ++frame_) {
    const Detections& out = camera.look_at(scene_);
    ASSERT_EQ(out.robots.size(), 1u);
    EXPECT_EQ(out.robots[0].state, TrackState::kPredicted);
    EXPECT_EQ(out.robots[0].id, 2);
    EXPECT_TRUE(out.robots[0].tags.empty());
    EXPECT_NEAR(out.robots[0].position_mm.x, -300.0 + 10.0 * frame_, 2.0);
    EXPECT_LT(out.robots[0].confidence, confidence);
    EXPECT_GT(out.robots[0].confidence, 0.0);
    confidence = out.robots[0].confidence;
  }
  EXPECT_TRUE(camera.look_at(scene_).robots.empty());
}

TEST_F(IdentityTest, PredictionStaysInTheField) {
  TrackingParameters parameters = standard_parameters();
  parameters.predict_frames = 25;
  Camera camera({two_tags()}, parameters);
  for (int i = 0; i < 8; ++i) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 2, {{400.0 + 40.0 * i, 0}, 1.0});
    camera.look_at(scene_);
  }
  scene_.clear();
  for (int i = 0; i < 25; ++i) EXPECT_LT(camera.look_at(scene_).robots.at(0).position_mm.x, 900.0);
}

TEST_F(IdentityTest, AnIdThatTurnsUpElsewhereLeavesNothingBehind) {
  Camera camera({two_tags()});
  scene_.add_robot(two_tags(), kBlue, 0, {{-500, 0}, 1.0});
  for (int i = 0; i < 10; ++i) camera.look_at(scene_);
  scene_.clear();
  scene_.add_robot(two_tags(), kBlue, 0, {{500, 300}, 2.0});
  const Detections& out = camera.look_at(scene_);
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_LT(distance_mm(out.robots[0].position_mm, {500, 300}), 0.1);
  EXPECT_EQ(out.robots[0].velocity_mm_s, cv::Point2d());
}

TEST_F(IdentityTest, AReplacedRobotDoesNotLeaveItsPredictionUnderTheNewOne) {
  Camera camera({two_tags()});
  scene_.add_robot(two_tags(), kBlue, 0, {{-500, 0}, 1.0});
  for (int i = 0; i < 10; ++i) camera.look_at(scene_);
  scene_.clear();
  scene_.add_robot(two_tags(), kYellow, 1, {{-490, 0}, 1.0});
  const Detections& out = camera.look_at(scene_);
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].team, Team::kYellow);
}

TEST_F(IdentityTest, SeveralUnknownRobotsAreKeptApartByMotion) {
  Camera camera({two_tags()});
  for (int i = 0; i < 30; ++i) {
    scene_.clear();
    for (int robot = 0; robot < 3; ++robot) {
      scene_.add_colored_robot(two_tags(), kYellow, {color("brown")},
                               {{-300.0 + 8.0 * i, -200.0 + 120.0 * robot}, 0.1 * i});
    }
    // Of the middle one, the player tag is seen every other frame.
    if (i % 2 == 1) scene_.blobs().erase(scene_.blobs().begin() + 3);
    const Detections& out = camera.look_at(scene_);
    ASSERT_EQ(out.robots.size(), 3u);
    for (const RobotDetection& robot : out.robots) {
      EXPECT_EQ(robot.id, kUnknownId);
      EXPECT_NEAR(wrap_turn(robot.heading_rad - 0.1 * i), 0.0, 0.1);
      if (i > 3) {
        EXPECT_NEAR(robot.velocity_mm_s.x, 480.0, 60.0);
      }
    }
  }
}

TEST_F(IdentityTest, TeamHalvesThatRunIntoEachOtherAreTwoRobots) {
  for (const TagLayout& layout : {two_tags(), three_tags()}) {
    for (const bool known_before : {true, false}) {
      Camera camera({layout});
      for (int i = 0; i < (known_before ? 6 : 1); ++i) {
        scene_.clear();
        scene_.add_robot(layout, kBlue, 1, {{0, 0}, 0.0});
        scene_.add_robot(layout, kBlue, 3, {{0, 75}, 0.0});
        if (!known_before || i == 5) scene_.merge(0, layout.patches.size());
        const Detections& out = camera.look_at(scene_);
        ASSERT_EQ(out.robots.size(), 2u);
        EXPECT_EQ(out.robots[0].id, 1);
        EXPECT_LT(distance_mm(out.robots[0].position_mm, {0, 0}), 3.0);
        EXPECT_NEAR(out.robots[0].heading_rad, 0.0, radians(5));
        EXPECT_EQ(out.robots[1].id, 3);
        EXPECT_LT(distance_mm(out.robots[1].position_mm, {0, 75}), 3.0);
        EXPECT_NEAR(out.robots[1].heading_rad, 0.0, radians(5));
      }
    }
  }
}

TEST_F(IdentityTest, TeamHalvesMergedBackToBackAreBridgedByMotion) {
  Camera camera({two_tags()});
  for (int i = 0; i < 12; ++i) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 1, {{0, 0}, 0.0});
    scene_.add_robot(two_tags(), kBlue, 3, {{-75, 0}, kPi});
    if (i > 5) scene_.merge(0, 2);
    const Detections& out = camera.look_at(scene_);
    ASSERT_EQ(out.robots.size(), 2u);
    EXPECT_EQ(out.robots[0].id, 1);
    EXPECT_LT(distance_mm(out.robots[0].position_mm, {0, 0}), 3.0);
    EXPECT_EQ(out.robots[1].id, 3);
    EXPECT_LT(distance_mm(out.robots[1].position_mm, {-75, 0}), 3.0);
  }
}

TEST_F(IdentityTest, PlayerPatchesOfOneColorThatRunTogetherAreStillTwoRobots) {
  Camera camera({two_tags()});
  for (int i = 0; i < 8; ++i) {
    scene_.clear();
    scene_.add_robot(two_tags(), kBlue, 1, {{0, 0}, 0.0});
    scene_.add_robot(two_tags(), kYellow, 1, {{0, 75}, 0.0});
    if (i > 4) scene_.merge(1, 3);
    const Detections& out = camera.look_at(scene_);
    ASSERT_EQ(out.robots.size(), 2u);
    EXPECT_EQ(out.robots[0].id, 1);
    EXPECT_EQ(out.robots[1].id, 1);
    EXPECT_LT(distance_mm(out.robots[1].position_mm, {0, 75}), 3.0);
  }
}

TEST_F(IdentityTest, ATimeThatJumpsOrGoesBackForgetsMotionAndFindsIdsAtOnce) {
  for (const double step_s : {-0.3, 2.0}) {
    Camera camera({two_tags()});
    frame_ = 0;
    warm_up(camera, two_tags(), 0);
    // Another robot in the first one's place: nothing of the old motion may speak for the old id.
    const Detections& out = camera.look_at(scene_at(frame_, two_tags(), 1), step_s);
    ASSERT_EQ(out.robots.size(), 1u);
    EXPECT_EQ(out.robots[0].id, 1);
    EXPECT_EQ(out.robots[0].velocity_mm_s, cv::Point2d());
  }
}

TEST_F(IdentityTest, TwoFramesOfOneTimeAreHarmless) {
  Camera camera({two_tags()});
  warm_up(camera, two_tags(), 0);
  for (int i = 0; i < 3; ++i, ++frame_) {
    expect_followed(camera.look_at(scene_at(frame_, two_tags(), 0), 0.0), 0, 2.0, 5.0);
  }
}

}  // namespace
}  // namespace maggic::tracking
