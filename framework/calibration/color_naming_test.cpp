#include "calibration/color_naming.hpp"

#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <gmock/gmock.h>

#include "calibration/chroma_frame.hpp"
#include "calibration/tags_for_tests.hpp"
#include "maggic/picture_colors.hpp"

namespace maggic::calibration {
namespace {

using tags::label;
using ::testing::Each;
using ::testing::Eq;
using ::testing::SizeIs;

TrackedPattern two_tag_pattern() {
  return {.layouts = {two_tag_layout(Palette::standard())},
          .blue_team_color = label("blue"),
          .yellow_team_color = label("yellow"),
          .ball_color = label("orange"),
          .ball_diameter_mm = 42.7};
}

double hue_of_name(std::string_view name) {
  const DisplayColor shown = Palette::standard().display_color(label(name));
  return hue_of({shown.blue, shown.green, shown.red});
}

/// One frame with robots side by side and what each patch is.
class Scene {
 public:
  /// @param cast added to every hue.
  explicit Scene(double cast = 0.0) : cast_(cast) {}

  Scene& robot(std::string_view team, std::string_view player) {
    return pair(hue_of_name(team) + cast_, hue_of_name(player) + cast_, label(team), label(player));
  }
  /// Patches that lie to each other like those of a tag.
  Scene& pair(double first_hue, double second_hue, Label first = kBackground,
              Label second = kBackground) {
    const std::array<double, 2> hues{std::fmod(first_hue + 256.0, 256.0),
                                     std::fmod(second_hue + 256.0, 256.0)};
    const auto place = static_cast<double>(frame_.patches.size());
    tags::add_robot(pattern_.layouts[0], {{60.0 + 50.0 * place, 100.0}, 37.0 * place}, hues,
                    frame_.patches);
    truth_.push_back(first);
    truth_.push_back(second);
    return *this;
  }

  Naming name(std::size_t frames = 3) {
    frame_.candidates = list_candidates(frame_.patches, pattern_.layouts, TagMetric::of_scale(2.5));
    frames_.assign(frames, frame_);
    return name_colors(frames_, pattern_, Palette::standard());
  }

  const std::vector<Label>& truth() const { return truth_; }

 private:
  TrackedPattern pattern_ = two_tag_pattern();
  double cast_;
  FramePatches frame_;
  std::vector<FramePatches> frames_;  ///< What a Naming points into.
  std::vector<Label> truth_;
};

Scene two_teams_of_three(double cast = 0.0) {
  Scene scene(cast);
  for (const std::string_view player : {"red", "green", "cyan"}) {
    scene.robot("blue", player).robot("yellow", player);
  }
  return scene;
}

TEST(ColorNaming, NamesTwoTeamsOfThreeByTheirPattern) {
  Scene scene = two_teams_of_three();
  const Naming naming = scene.name();
  EXPECT_EQ(naming.robots, 18.0);
  ASSERT_THAT(naming.frames, SizeIs(3));
  for (const NamedFrame& frame : naming.frames) {
    EXPECT_EQ(frame.label_of_patch, scene.truth());
    EXPECT_THAT(frame.robots, Each(::testing::Field(&NamedRobot::is_listed, true)));
  }
}

TEST(ColorNaming, LightThatTurnsEveryHueChangesNoName) {
  for (const double cast : {-12.0, 15.0}) {
    Scene scene = two_teams_of_three(cast);
    const Naming naming = scene.name();
    EXPECT_EQ(naming.frames[0].label_of_patch, scene.truth()) << cast;
  }
}

TEST(ColorNaming, APairOfTwoPlayerColoursOrTwoTeamColoursIsNoRobot) {
  Scene scene = two_teams_of_three();
  scene.pair(hue_of_name("red"), hue_of_name("green"));
  scene.pair(hue_of_name("blue"), hue_of_name("yellow"));
  const Naming naming = scene.name();
  EXPECT_EQ(naming.frames[0].label_of_patch, scene.truth());
  EXPECT_THAT(naming.frames[0].robots, SizeIs(6));
}

TEST(ColorNaming, APairOfOneHueIsNoRobot) {
  Scene scene = two_teams_of_three();
  scene.pair(20.0, 20.0);  // two pieces of wood
  const Naming naming = scene.name();
  EXPECT_EQ(naming.frames[0].label_of_patch, scene.truth());
}

TEST(ColorNaming, NoIdentityIsThereTwiceInOneTeam) {
  Scene scene = two_teams_of_three();
  scene.robot("blue", "red");
  const Naming naming = scene.name();
  for (const NamedFrame& frame : naming.frames) {
    std::set<std::pair<Label, Label>> identities;
    for (const NamedRobot& robot : frame.robots) {
      const auto player = static_cast<std::size_t>(robot.candidate->patches[1]);
      EXPECT_TRUE(identities.insert({robot.team, frame.label_of_patch[player]}).second);
    }
    EXPECT_THAT(frame.robots, SizeIs(6));
  }
}

TEST(ColorNaming, OneTeamAloneIsNamedToo) {
  Scene scene;
  scene.robot("yellow", "red").robot("yellow", "green").robot("yellow", "cyan");
  const Naming naming = scene.name();
  EXPECT_EQ(naming.frames[0].label_of_patch, scene.truth());
}

TEST(ColorNaming, WithoutPatchesThereIsNoRobot) {
  const std::vector<FramePatches> frames(2);
  const Naming naming = name_colors(frames, two_tag_pattern(), Palette::standard());
  EXPECT_EQ(naming.robots, 0.0);
  EXPECT_THAT(naming.frames, SizeIs(2));
}

}  // namespace
}  // namespace maggic::calibration
