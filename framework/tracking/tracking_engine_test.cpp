/// One frame at a time: robots are found where they are, as who they are.

#include "maggic/tracking_engine.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tracking/angles.hpp"
#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {
namespace {

struct Placed {
  Team team;
  int id;
  const TagLayout* layout;
  Pose pose;
};

Label team_color(Team team) { return color(team == Team::kBlue ? "blue" : "yellow"); }

TagLayout two_discs() {
  return {"discs",
          {{PatchRole::kTeam, PatchShape::kDisc, {-18, 0}, {32, 32}, 0},
           {PatchRole::kPlayer, PatchShape::kDisc, {18, 0}, {32, 32}, 0}},
          {{30, {color("red")}}, {31, {color("green")}}, {32, {color("magenta")}}},
          90.0};
}

/// Robots of both teams at poses that do not overlap, gap and all.
std::vector<Placed> random_robots(Dice& dice, const std::vector<TagLayout>& layouts, int a_team,
                                  double gap_mm) {
  std::vector<Placed> robots;
  for (const Team team : {Team::kBlue, Team::kYellow}) {
    std::vector<int> used;
    for (int i = 0; i < a_team; ++i) {
      const TagLayout& layout =
          layouts[static_cast<std::size_t>(dice.below(static_cast<int>(layouts.size())))];
      const int id =
          layout.ids[static_cast<std::size_t>(dice.below(static_cast<int>(layout.ids.size())))].id;
      if (std::ranges::count(used, id) > 0) continue;
      const Pose pose{{dice.uniform(-680, 680), dice.uniform(-580, 580)}, dice.uniform(-kPi, kPi)};
      const bool is_free = std::ranges::none_of(robots, [&](const Placed& other) {
        // Squares of 75 mm cannot overlap when their circumscribed circles do not.
        return distance_mm(other.pose.position_mm, pose.position_mm) < 107.0 + gap_mm;
      });
      if (!is_free) continue;
      used.push_back(id);
      robots.push_back({team, id, &layout, pose});
    }
  }
  return robots;
}

Pose expected_pose(const Placed& robot) {
  return {robot.pose.position_mm,
          wrap_turn(robot.pose.heading_rad + radians(robot.layout->heading_offset_deg))};
}

void assert_all_found(const Detections& out, const std::vector<Placed>& robots, double mm,
                      double deg) {
  RC_ASSERT(out.robots.size() == robots.size());
  for (const Placed& robot : robots) {
    const RobotDetection* found = robot_of(out, robot.team, robot.id);
    RC_ASSERT(found != nullptr);
    const Pose truth = expected_pose(robot);
    RC_ASSERT(distance_mm(found->position_mm, truth.position_mm) < mm);
    RC_ASSERT(std::abs(wrap_turn(found->heading_rad - truth.heading_rad)) < radians(deg));
    RC_ASSERT(found->state == TrackState::kSeen);
  }
}

Scene scene_of(const std::vector<Placed>& robots, const FieldParameters& field = {}) {
  Scene scene(field);
  for (const Placed& robot : robots) {
    scene.add_robot(*robot.layout, team_color(robot.team), robot.id, robot.pose);
  }
  return scene;
}

const std::vector<TagLayout>& layouts_of_choice(int choice) {
  static const std::vector<std::vector<TagLayout>> kChoices = [] {
    // Ids of the two built-in patterns overlap; where both play, two-tag ids start at 10.
    TagLayout shifted = two_tags();
    for (TagId& entry : shifted.ids) entry.id += 10;
    return std::vector<std::vector<TagLayout>>{
        {two_tags()}, {three_tags()}, {diagonal_squares()}, {two_discs()}, {shifted, three_tags()}};
  }();
  return kChoices[static_cast<std::size_t>(choice)];
}

RC_GTEST_PROP(MatchingTest, FindsEveryRobotOfEveryLayoutAtOnce, (std::uint32_t seed)) {
  Dice dice(seed);
  const std::vector<TagLayout>& layouts = layouts_of_choice(*rc::gen::inRange(0, 5));
  const std::vector<Placed> robots = random_robots(dice, layouts, 11, 0.0);
  Scene scene = scene_of(robots);
  std::vector<Blob>& blobs = scene.blobs();
  std::rotate(blobs.begin(), blobs.begin() + static_cast<std::ptrdiff_t>(blobs.size() / 3),
              blobs.end());
  Camera camera(layouts);
  assert_all_found(camera.look_at(scene), robots, 0.05, 0.05);
}

RC_GTEST_PROP(MatchingTest, NoiseOfCentroidsMovesPosesALittleAndNoIds, (std::uint32_t seed)) {
  Dice dice(seed);
  const std::vector<TagLayout>& layouts = layouts_of_choice(*rc::gen::inRange(0, 5));
  const std::vector<Placed> robots = random_robots(dice, layouts, 8, 0.0);
  Scene scene = scene_of(robots);
  scene.shake(dice, 0.3);
  Camera camera(layouts);
  assert_all_found(camera.look_at(scene), robots, 4.0, 10.0);
}

RC_GTEST_PROP(MatchingTest, SpecksOfEveryColorChangeNothing, (std::uint32_t seed)) {
  Dice dice(seed);
  const std::vector<TagLayout>& layouts = layouts_of_choice(*rc::gen::inRange(0, 5));
  const std::vector<Placed> robots = random_robots(dice, layouts, 5, 0.0);
  Scene scene = scene_of(robots);
  for (int i = 0; i < 150; ++i) {
    const auto label = static_cast<Label>(2 + dice.below(8));
    scene.add(label, {dice.uniform(-750, 750), dice.uniform(-650, 650)}, 75.0,
              {dice.uniform(2, 16), dice.uniform(2, 16)}, dice.uniform(0, kPi),
              dice.uniform(4, 200));
  }
  Camera camera(layouts);
  assert_all_found(camera.look_at(scene), robots, 0.05, 0.05);
}

RC_GTEST_PROP(MatchingTest, TurningTheWholeSceneTurnsTheAnswer, (std::uint32_t seed)) {
  Dice dice(seed);
  const std::vector<TagLayout>& layouts = layouts_of_choice(*rc::gen::inRange(0, 5));
  std::vector<Placed> robots = random_robots(dice, layouts, 6, 0.0);
  Camera before(layouts);
  assert_all_found(before.look_at(scene_of(robots)), robots, 0.05, 0.05);
  const double turn = dice.uniform(-kPi, kPi);
  const Pose motion{{dice.uniform(-50, 50), dice.uniform(-50, 50)}, turn};
  std::erase_if(robots, [&](Placed& robot) {
    robot.pose = {motion.apply(robot.pose.position_mm), robot.pose.heading_rad + turn};
    return std::abs(robot.pose.position_mm.x) > 800 || std::abs(robot.pose.position_mm.y) > 640;
  });
  Camera after(layouts);
  assert_all_found(after.look_at(scene_of(robots)), robots, 0.05, 0.05);
}

TEST(MatchingTest, PerspectiveAndLensAreTheFieldsBusiness) {
  FieldParameters field;
  field.corners_px = {{60, 40}, {600, 55}, {580, 440}, {50, 420}};
  field.image_size_px = {640, 480};
  field.lens_k1 = -0.12;
  field.camera_position_mm = {120, -60};
  const TagLayout layout = three_tags();
  const std::vector<Placed> robots{{Team::kBlue, 3, &layout, {{-600, 500}, 2.0}},
                                   {Team::kYellow, 8, &layout, {{640, -520}, -1.0}}};
  Camera camera({layout});
  const Detections& out = camera.look_at(scene_of(robots, field));
  ASSERT_EQ(out.robots.size(), 2u);
  EXPECT_LT(distance_mm(out.robots[0].position_mm, {-600, 500}), 0.5);
  EXPECT_LT(distance_mm(out.robots[1].position_mm, {640, -520}), 0.5);
}

TEST(MatchingTest, ReportsTagsTeamFirstThenPlayersInTheLayoutsOrder) {
  Scene scene;
  scene.add_robot(three_tags(), color("blue"), 4, {{100, 100}, 0.5});
  Camera camera({three_tags()});
  const Detections& out = camera.look_at(scene);
  ASSERT_EQ(out.robots.size(), 1u);
  const RobotDetection& robot = out.robots[0];
  EXPECT_THAT(robot.player_colors, testing::ElementsAre(color("green"), color("magenta")));
  ASSERT_EQ(robot.tags.size(), 3u);
  EXPECT_EQ(robot.tags[0].label, color("blue"));
  EXPECT_EQ(robot.tags[1].label, color("green"));
  EXPECT_EQ(robot.tags[2].centroid_px, scene.blobs()[2].centroid_px);
  const cv::Point2d center = scene.field().to_image_px({100, 100}, 75.0);
  EXPECT_LT(distance_mm(robot.centroid_px, center), 0.05);
  EXPECT_EQ(robot.velocity_mm_s, cv::Point2d());
  EXPECT_GT(robot.confidence, 0.9);
}

TEST(MatchingTest, RobotsAreOrderedByTeamThenIdThenUnknown) {
  Scene scene;
  const TagLayout layout = two_tags();
  scene.add_robot(layout, color("yellow"), 3, {{-300, 0}, 0.5});
  scene.add_colored_robot(layout, color("yellow"), {color("brown")}, {{-300, 200}, 0.5});
  scene.add_robot(layout, color("blue"), 2, {{300, 0}, 0.5});
  scene.add_robot(layout, color("blue"), 0, {{300, 200}, 0.5});
  Camera camera({layout});
  std::vector<std::pair<Team, int>> order;
  for (const RobotDetection& r : camera.look_at(scene).robots) order.emplace_back(r.team, r.id);
  EXPECT_THAT(order, testing::ElementsAre(std::pair(Team::kBlue, 0), std::pair(Team::kBlue, 2),
                                          std::pair(Team::kYellow, 3),
                                          std::pair(Team::kYellow, kUnknownId)));
}

TEST(MatchingTest, RobotsSideBySideFaceToFaceAndNoseToTailAreNotCrossed) {
  const TagLayout layout = two_tags();
  // Neighbours as near as two cubes can be, in every relative direction.
  for (int turn_a = 0; turn_a < 4; ++turn_a) {
    for (int turn_b = 0; turn_b < 4; ++turn_b) {
      for (const cv::Point2d apart :
           {cv::Point2d(75, 0), cv::Point2d(75, 35), cv::Point2d(0, 75)}) {
        const std::vector<Placed> robots{
            {Team::kBlue, 0, &layout, {{10, 20}, turn_a * kPi / 2}},
            {Team::kBlue, 1, &layout, {cv::Point2d(10, 20) + apart, turn_b * kPi / 2}},
            {Team::kBlue, 2, &layout, {cv::Point2d(10, 20) - apart, turn_b * kPi / 2}}};
        Camera camera({layout});
        const Detections& out = camera.look_at(scene_of(robots));
        ASSERT_EQ(out.robots.size(), 3u);
        for (const Placed& robot : robots) {
          const RobotDetection* found = robot_of(out, Team::kBlue, robot.id);
          ASSERT_NE(found, nullptr);
          EXPECT_LT(distance_mm(found->position_mm, robot.pose.position_mm), 0.1);
        }
      }
    }
  }
}

TEST(MatchingTest, AThreeTagRobotIsNeverReadAsATwoTagOne) {
  const TagLayout two = two_tags();
  const TagLayout three = three_tags();
  Scene scene;
  scene.add_robot(three, color("blue"), 0, {{0, 0}, 0.3});
  scene.add_robot(two, color("blue"), 3, {{80, 0}, 0.3});
  scene.add_robot(three, color("yellow"), 6, {{0, 200}, -1.3});
  Camera camera({two, three});
  const Detections& out = camera.look_at(scene);
  ASSERT_EQ(out.robots.size(), 3u);
  EXPECT_EQ(out.robots[0].id, 0);
  EXPECT_EQ(out.robots[0].tags.size(), 3u);
  EXPECT_EQ(out.robots[1].id, 3);
  EXPECT_EQ(out.robots[2].id, 6);
}

TEST(MatchingTest, OfTwoRobotsWithOneIdTheSecondIsReportedAsUnknown) {
  Scene scene;
  scene.add_robot(two_tags(), color("blue"), 0, {{-300, 0}, 0.3});
  scene.add_robot(two_tags(), color("blue"), 0, {{300, 0}, 0.3});
  Camera camera({two_tags()});
  const Detections& out = camera.look_at(scene);
  ASSERT_EQ(out.robots.size(), 2u);
  EXPECT_EQ(out.robots[0].id, 0);
  EXPECT_EQ(out.robots[1].id, kUnknownId);
}

TEST(MatchingTest, AnUnknownOpponentIsReportedWithItsHeading) {
  Scene scene;
  scene.add_colored_robot(two_tags(), color("yellow"), {color("brown")}, {{-300, 120}, 2.3});
  Camera camera({two_tags()});
  const Detections& out = camera.look_at(scene);
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].id, kUnknownId);
  EXPECT_NEAR(out.robots[0].heading_rad, 2.3, 1e-2);
  EXPECT_THAT(out.robots[0].player_colors, testing::ElementsAre(color("brown")));
}

TEST(MatchingTest, ATeamPatchAloneIsARobotOfUnknownIdWithTheLineOfItsHeading) {
  Scene scene;
  scene.add_patch(two_tags().patches[0], color("yellow"), {{-300, 120}, 0.6});
  Camera camera({two_tags()});
  const Detections& out = camera.look_at(scene);
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].id, kUnknownId);
  EXPECT_TRUE(out.robots[0].player_colors.empty());
  EXPECT_NEAR(wrap_line(out.robots[0].heading_rad - 0.6), 0.0, 0.02);
  EXPECT_LT(distance_mm(out.robots[0].position_mm, {-300, 120}), 18.0);
  EXPECT_LE(out.robots[0].confidence, 0.3);
}

TEST(MatchingTest, UnknownRobotsCanBeLeftOut) {
  Scene scene;
  scene.add_colored_robot(two_tags(), color("yellow"), {color("brown")}, {{-300, 120}, 2.3});
  scene.add_patch(two_tags().patches[0], color("yellow"), {{300, 120}, 0.6});
  TrackingParameters parameters = standard_parameters();
  parameters.report_unknown = false;
  Camera camera({two_tags()}, parameters);
  EXPECT_TRUE(camera.look_at(scene).robots.empty());
}

TEST(MatchingTest, BlobsOfTeamColorThatAreNoTagAreNoRobots) {
  Scene scene;
  const Label yellow = color("yellow");
  scene.add(yellow, {-600, 0}, 75.0, {300, 12}, 0.4, 3600);    // a line
  scene.add(yellow, {-300, 0}, 75.0, {50, 50}, 0.0, 2500);     // a square
  scene.add(yellow, {0, 0}, 75.0, {120, 110}, 0.2, 13000);     // a shirt
  scene.add(yellow, {300, 0}, 75.0, {10, 20}, 0.2, 200);       // a speck
  scene.add(yellow, {500, 300}, 75.0, {35, 70}, 0.2, 1300);    // a lace of pixels
  scene.add(yellow, {-100, -790}, 75.0, {35, 70}, 0.2, 2450);  // beside the field
  Camera camera({two_tags()});
  EXPECT_TRUE(camera.look_at(scene).robots.empty());
}

TEST(MatchingTest, NoMoreRobotsATeamThanAllowed) {
  TrackingParameters parameters = standard_parameters();
  parameters.max_robots_per_team = 2;
  Scene scene;
  for (int id = 0; id < 4; ++id) {
    scene.add_robot(two_tags(), color("blue"), id, {{-400.0 + 200.0 * id, 0}, 1.0});
  }
  Camera camera({two_tags()}, parameters);
  EXPECT_EQ(camera.look_at(scene).robots.size(), 2u);
}

/// Eight patches on a ring, and a robot with them among a great many blobs of tag colours.
class NoiseTest : public testing::Test {
 protected:
  struct Warnings : Reporter {
    void warn(std::string_view) override { ++count; }
    int count = 0;
  };

  static TagLayout ring() {
    TagLayout layout{"ring", {}, {}, 0.0};
    for (int i = 0; i < 8; ++i) {
      const double angle = kPi / 4.0 * i + (i == 1 ? 0.15 : 0.0);
      layout.patches.push_back({i == 0 ? PatchRole::kTeam : PatchRole::kPlayer,
                                PatchShape::kDisc,
                                {40 * std::cos(angle), 40 * std::sin(angle)},
                                {20, 20},
                                0});
    }
    const auto [r, g, c] = std::tuple(color("red"), color("green"), color("cyan"));
    layout.ids = {{0, {r, g, c, r, g, c, r}}, {1, {g, g, c, c, r, r, g}}};
    return layout;
  }

  static void add_noise(Scene& scene, int count, double mm2) {
    Dice dice(3);
    const double side = std::sqrt(mm2);
    for (int i = 0; i < count; ++i) {
      scene.add(color(std::array{"blue", "yellow", "red", "green", "cyan"}[dice.below(5)]),
                {dice.uniform(-750, 750), dice.uniform(-650, 650)}, 75.0, {side, side},
                dice.uniform(0, kPi), mm2 * dice.uniform(0.6, 1.5));
    }
  }

  /// Milliseconds of processor time a frame takes.
  double look(const TagLayout& layout, const Scene& scene, int frames = 3) {
    TrackingEngine engine(standard_parameters(), {layout}, &warnings_);
    const std::clock_t begin = std::clock();
    for (int i = 0; i < frames; ++i) {
      engine.track(
          {static_cast<std::uint64_t>(i), Timestamp(i * 16'666'667), scene.blobs(), scene.field()},
          out_);
    }
    return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / frames;
  }

  Warnings warnings_;
  Detections out_;
};

TEST_F(NoiseTest, AFrameOfNoiseTakesBoundedTimeAndIsReported) {
  for (const TagLayout& layout : {ring(), two_tags(), three_tags()}) {
    Scene scene;
    add_noise(scene, 4000, layout.patches[1].expected_area_mm2());
    warnings_.count = 0;
    // Sanitizers and busy machines included; a full search would take hours.
    EXPECT_LT(look(layout, scene), 3000.0) << layout.name;
    EXPECT_EQ(warnings_.count, 3) << layout.name;
  }
}

TEST_F(NoiseTest, AUsualFrameIsSearchedInFull) {
  Scene scene;
  scene.add_robot(ring(), color("blue"), 1, {{-200, 100}, 0.7});
  scene.add_robot(ring(), color("yellow"), 0, {{200, 100}, -0.7});
  look(ring(), scene);
  EXPECT_EQ(warnings_.count, 0);
  ASSERT_EQ(out_.robots.size(), 2u);
  EXPECT_EQ(out_.robots[0].id, 1);
  EXPECT_EQ(out_.robots[1].id, 0);
}

TEST_F(NoiseTest, RobotsAreFoundAmongNoiseThatIsCutShort) {
  Scene scene;
  for (int id = 0; id < 2; ++id) {
    scene.add_robot(ring(), color("blue"), id, {{-400.0 + 800.0 * id, 100}, 0.7});
  }
  add_noise(scene, 1200, ring().patches[1].expected_area_mm2());
  // The robots' places are free of noise, as a tag is opaque, and so is what lies round them: noise
  // that makes a robot with one of their patches can be worth more than that patch is to them.
  constexpr double kFreeMm = 160.0;
  std::erase_if(scene.blobs(), [&, index = 0](const Blob& blob) mutable {
    if (index++ < 16) return false;
    const cv::Point2d at = scene.field().to_field_mm(blob.centroid_px, 75.0);
    return distance_mm(at, {-400, 100}) < kFreeMm || distance_mm(at, {400, 100}) < kFreeMm;
  });
  look(ring(), scene);
  EXPECT_GT(warnings_.count, 0);
  for (int id = 0; id < 2; ++id) {
    const RobotDetection* robot = robot_of(out_, Team::kBlue, id);
    ASSERT_NE(robot, nullptr);
    EXPECT_LT(distance_mm(robot->position_mm, {-400.0 + 800.0 * id, 100}), 1.0);
  }
}

TEST(TrackingEngineTest, RefusesLayoutsThatMakeNoSense) {
  const TrackingParameters parameters = standard_parameters();
  EXPECT_THROW(TrackingEngine(parameters, {}), std::invalid_argument);
  TagLayout no_team = two_tags();
  no_team.patches.erase(no_team.patches.begin());
  EXPECT_THROW(TrackingEngine(parameters, {no_team}), std::invalid_argument);
  TagLayout wrong_colors = three_tags();
  wrong_colors.ids[0].colors.pop_back();
  EXPECT_THROW(TrackingEngine(parameters, {wrong_colors}), std::invalid_argument);
}

}  // namespace
}  // namespace maggic::tracking
