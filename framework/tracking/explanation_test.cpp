/// Every blob has an answer to why it is, or is not, part of an object.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tracking/angles.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const cv::Size2d kHalf(35, 70);

/// What one look at a scene makes of a blob.
std::string explanation(const Scene& scene, std::size_t blob,
                        const TrackingParameters& parameters = standard_parameters()) {
  Camera camera({two_tags()}, parameters);
  camera.look_at(scene);
  return camera.explain(scene, blob);
}

/// A patch lying alone, its longer side along y.
Blob& add_alone(Scene& scene, std::string_view name, cv::Point2d at_mm,
                cv::Size2d size_mm = kHalf) {
  return scene.add(color(name), at_mm, scene.field().robot_height_mm(), size_mm, 0.0,
                   size_mm.area());
}

TEST(Explanation, NamesTheRobotAndThePatch) {
  Scene scene;
  scene.add_robot(two_tags(), color("yellow"), 1, {{100, 50}, 0.4});
  EXPECT_THAT(explanation(scene, 0),
              AllOf(StartsWith("team patch of yellow robot 1 at "), HasSubstr("with the green")));
  EXPECT_THAT(explanation(scene, 1), StartsWith("player patch 1 of yellow robot 1 at "));
}

TEST(Explanation, NamesTheBall) {
  Scene scene;
  scene.add_ball({0, 0});
  EXPECT_EQ(explanation(scene, 0), "the ball");
}

TEST(Explanation, SaysThatColorsAreInNoIdTable) {
  Scene scene;
  scene.add_colored_robot(two_tags(), color("blue"), {color("brown")}, {{0, 0}, 0});
  EXPECT_THAT(explanation(scene, 0),
              AllOf(StartsWith("team patch of a blue robot of unknown id"),
                    HasSubstr("its player colours (brown) are in no id table")));
  TrackingParameters silent = standard_parameters();
  silent.report_unknown = false;
  EXPECT_THAT(explanation(scene, 0, silent),
              HasSubstr("are in no id table, and report_unknown is false"));
}

TEST(Explanation, SaysHowFarThePartnerIsOff) {
  Scene scene;
  add_alone(scene, "red", {0, 0});
  add_alone(scene, "blue", {80, 0});
  EXPECT_THAT(explanation(scene, 0), AllOf(StartsWith("no team patch goes with it: blue blob at "),
                                           HasSubstr("80 mm apart, expected 35 ± 24 mm")));
  TrackingParameters silent = standard_parameters();
  silent.report_unknown = false;
  EXPECT_THAT(explanation(scene, 1, silent),
              AllOf(StartsWith("no player patch goes with it: red blob at "),
                    HasSubstr("80 mm apart, expected 35 ± 24 mm")));
}

TEST(Explanation, SaysWhenThereIsNoPartnerAtAll) {
  Scene scene;
  add_alone(scene, "red", {0, 0});
  EXPECT_EQ(explanation(scene, 0), "no team patch goes with it: there is none in the frame");
  Scene lone;
  add_alone(lone, "blue", {0, 0});
  EXPECT_THAT(explanation(lone, 0),
              AllOf(StartsWith("team patch of a blue robot of unknown id"),
                    HasSubstr("no player patch was found with it: no blob that could be one")));
}

TEST(Explanation, SaysWhichAreaLimitAPatchMisses) {
  Scene scene;
  add_alone(scene, "red", {0, 0}, {15, 30});
  EXPECT_THAT(explanation(scene, 0), AllOf(HasSubstr("mm² is less than any patch shows (735 mm²"),
                                           HasSubstr("patch_min_area_ratio 0.3")));
  Scene large;
  add_alone(large, "red", {0, 0}, {100, 100});
  EXPECT_THAT(explanation(large, 0), HasSubstr("mm² is more than any patch"));
}

TEST(Explanation, SaysWhoTookTheId) {
  Scene scene;
  scene.add_robot(two_tags(), color("blue"), 0, {{-300, 0}, 0});
  scene.add_robot(two_tags(), color("blue"), 0, {{300, 0}, 0});
  // The second red patch is smaller, so the first robot fits better.
  scene.blobs()[3].area_px = scene.blobs()[3].area_px * 6 / 10;
  TrackingParameters silent = standard_parameters();
  silent.report_unknown = false;
  EXPECT_THAT(
      explanation(scene, 2, silent),
      AllOf(StartsWith("could be part of blue robot 0 with the red blob"),
            HasSubstr("the id is taken by blue robot 0 at "), HasSubstr("which fits better")));
}

TEST(Explanation, SaysThatTheTeamIsFull) {
  Scene scene;
  scene.add_robot(two_tags(), color("blue"), 0, {{-300, 0}, 0});
  scene.add_robot(two_tags(), color("blue"), 1, {{300, 0}, 0});
  scene.blobs()[3].area_px = scene.blobs()[3].area_px * 6 / 10;
  TrackingParameters one = standard_parameters();
  one.max_robots_per_team = 1;
  EXPECT_THAT(explanation(scene, 2, one), HasSubstr("max_robots_per_team 1 already"));
}

TEST(Explanation, SaysThatAPatchBelongsToAnotherRobot) {
  Scene scene;
  // The red patch lies between both team patches, nearer to where the first wants it.
  scene.add_robot(two_tags(), color("blue"), 0, {{0, 0}, 0});
  add_alone(scene, "yellow", {64, 0});
  TrackingParameters silent = standard_parameters();
  silent.report_unknown = false;
  EXPECT_THAT(explanation(scene, 2, silent),
              AllOf(HasSubstr("could be part of yellow robot 0 with the red blob"),
                    HasSubstr("its patches or its place belong to blue robot 0")));
}

TEST(Explanation, SaysThatTheBallIsTooSmallLongOrFarOutside) {
  Scene scene;
  scene.add_ball({0, 0}, color("orange"), 18.0);
  add_alone(scene, "orange", {0, 200}, {70, 20});
  scene.add_ball({1000, 0});
  EXPECT_THAT(explanation(scene, 0),
              AllOf(StartsWith("not the ball: its "), HasSubstr("ball_min_area_ratio is 0.25")));
  EXPECT_THAT(explanation(scene, 1), HasSubstr("times as long as wide, a ball is at most 2.2"));
  EXPECT_THAT(explanation(scene, 2), HasSubstr("more than 150 mm outside of the field"));
}

TEST(Explanation, SaysWhichBlobIsTheBallInstead) {
  Scene scene;
  scene.add_ball({2, 0});
  scene.add_ball({302, 0}, color("orange"), 30.0);
  EXPECT_THAT(explanation(scene, 1), StartsWith("not the ball: the blob at 320,240 is, 300 mm"));
}

TEST(Explanation, SaysThatABallTooFarOffHasToBeSeenTwice) {
  Camera camera({two_tags()});
  Scene here;
  here.add_ball({-500, 0});
  camera.look_at(here);
  Scene there;
  there.add_ball({500, 0});
  camera.look_at(there);
  EXPECT_THAT(camera.explain(there, 0),
              AllOf(StartsWith("not yet the ball: 1000 mm from the place expected"),
                    HasSubstr("seen here again in the next frame")));
  camera.look_at(there);
  EXPECT_EQ(camera.explain(there, 0), "the ball");
}

TEST(Explanation, SaysThatTheBallLiesInARobot) {
  Scene scene;
  scene.add_robot(two_tags(), color("blue"), 0, {{0, 0}, 0});
  scene.add_ball({0, 0}, color("orange"), 25.0);
  EXPECT_THAT(explanation(scene, 2), HasSubstr("within the body of a robot"));
}

TEST(Explanation, SaysThatAColorStandsForNothing) {
  Scene scene;
  add_alone(scene, "brown", {0, 0});
  EXPECT_THAT(explanation(scene, 0), StartsWith("brown is a player colour of no id"));
}

RC_GTEST_PROP(ExplanationProperty, AnswersForEveryBlobAndAgreesWithTheReport, ()) {
  Dice dice(*rc::gen::arbitrary<std::uint32_t>());
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    scene.add_robot(i % 2 == 0 ? two_tags() : three_tags(), color(i < 2 ? "blue" : "yellow"), i,
                    {{dice.uniform(-700, 700), dice.uniform(-600, 600)}, dice.uniform(-kPi, kPi)});
  }
  for (int i = 0; i < 12; ++i) {
    const double side_mm = dice.uniform(10, 90);
    scene.add(static_cast<Label>(1 + dice.below(9)),
              {dice.uniform(-760, 760), dice.uniform(-660, 660)}, scene.field().robot_height_mm(),
              {side_mm, dice.uniform(10, 90)}, dice.uniform(-kPi, kPi), side_mm * 40.0);
  }
  Camera camera({two_tags(), three_tags()});
  const Detections& out = camera.look_at(scene);
  for (std::size_t i = 0; i < scene.blobs().size(); ++i) {
    const std::string text = camera.explain(scene, i);
    RC_ASSERT(!text.empty());
    bool is_tag = false;
    for (const RobotDetection& robot : out.robots) {
      for (const TagSighting& tag : robot.tags) {
        is_tag = is_tag || tag.centroid_px == scene.blobs()[i].centroid_px;
      }
    }
    const bool says_so = text.starts_with("team patch of") || text.starts_with("player patch");
    RC_ASSERT(says_so == is_tag);
  }
}

}  // namespace
}  // namespace maggic::tracking
