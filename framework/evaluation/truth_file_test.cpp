#include "maggic/truth_file.hpp"

#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

Truth parse(std::string_view text) { return parse_truth(text, "t.json", Palette::standard()); }

std::string mistakes_in(std::string_view text) {
  try {
    parse(text);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no mistake";
}

/// An annotation with one part replaced.
std::string annotation(std::string_view robots, std::string_view ball = "null",
                       std::string_view head = R"("size_px": [640, 480], "tolerance_px": 2.5)") {
  return "{" + std::string(head) + ", \"ball\": " + std::string(ball) +
         ", \"robots\": " + std::string(robots) + "}";
}

TEST(TruthFile, ReadsAnAnnotationThatHoldsForEveryFrame) {
  const Truth truth = parse(R"({
    "media": "clip.mp4", "size_px": [640, 480], "tolerance_px": 2.5, "note": "left alone",
    "field_corners_px": [[39, -5], [601, -5], [601, 482], [39, 482]],
    "ball": {"x": 59.5, "y": 322.5},
    "robots": [{"team": "yellow", "player_colors": ["red", "cyan"], "x": 249.5, "y": 209.25,
                "heading_deg": 90, "tags": [{"color": "yellow", "x": 1, "y": 2}]}]})");
  EXPECT_EQ(truth.media, "clip.mp4");
  EXPECT_EQ(truth.size_px, cv::Size(640, 480));
  EXPECT_EQ(truth.tolerance.unit, Tolerance::Unit::kPixels);
  EXPECT_EQ(truth.tolerance.distance, 2.5);
  EXPECT_THAT(truth.field_corners_px, SizeIs(4));
  const TrueScene* scene = truth.at(123456);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->ball->centroid_px, cv::Point2d(59.5, 322.5));
  ASSERT_THAT(scene->robots, SizeIs(1));
  const TrueRobot& robot = scene->robots[0];
  const Palette palette = Palette::standard();
  EXPECT_EQ(name_of(robot.identity, palette), "yellow red+cyan");
  EXPECT_EQ(robot.centroid_px, cv::Point2d(249.5, 209.25));
  EXPECT_FALSE(robot.position_mm);
  EXPECT_FALSE(robot.heading_rad);
  EXPECT_NEAR(robot.picture_heading_rad.value(), 1.5 * std::numbers::pi, 1e-12)
      << "the front is the side of the player tags";
  ASSERT_THAT(robot.tags, SizeIs(1));
  EXPECT_EQ(palette.name(robot.tags[0].label), "yellow");
}

TEST(TruthFile, ReadsFramesWithGapsAsTheJsonlSinkWritesObjects) {
  const Truth truth = parse(R"({"size_px": [64, 48], "tolerance_mm": 5, "frames": [
    {"frame": 3, "t_capture": 0.1,
     "ball": {"x_mm": 1, "y_mm": 2, "x_px": 3, "y_px": 4, "state": "seen"},
     "robots": [{"team": "blue", "id": 2, "player_colors": ["red"], "x_mm": -5.5, "y_mm": 6,
                 "heading_rad": -1.5, "x_px": 7, "y_px": 8},
                {"team": "blue", "id": -1, "x_mm": 0, "y_mm": 0}]},
    {"frame": 7, "ball": null, "robots": []}]})");
  EXPECT_EQ(truth.tolerance.unit, Tolerance::Unit::kMillimeters);
  EXPECT_EQ(truth.at(0), nullptr);
  EXPECT_EQ(truth.at(4), nullptr);
  ASSERT_NE(truth.at(7), nullptr);
  EXPECT_FALSE(truth.at(7)->ball);
  const TrueScene* scene = truth.at(3);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->ball->position_mm, cv::Point2d(1, 2));
  EXPECT_EQ(scene->ball->centroid_px, cv::Point2d(3, 4));
  ASSERT_THAT(scene->robots, SizeIs(2));
  EXPECT_EQ(scene->robots[0].identity.id, 2);
  EXPECT_EQ(scene->robots[0].position_mm, cv::Point2d(-5.5, 6));
  EXPECT_EQ(scene->robots[0].heading_rad, -1.5);
  EXPECT_FALSE(scene->robots[1].identity.id);
}

TEST(TruthFile, TellsTheLineAndColumnOfWhatIsNoJson) {
  EXPECT_THAT(mistakes_in("{\"size_px\": [640, 480],\n  \"ball\": nul }"),
              StartsWith("t.json:2:14: this is not JSON; what was read last is '\"ball\": nul '"));
  EXPECT_THAT(mistakes_in("{\"a\": [1,\n2"), StartsWith("t.json:2:"));
  EXPECT_THAT(mistakes_in(""), StartsWith("t.json:1:1: "));
  EXPECT_THAT(mistakes_in("{\"a\": NaN}"), StartsWith("t.json:1:7: "));
  EXPECT_THAT(mistakes_in("{\"a\":\n 1e999}"),
              AllOf(StartsWith("t.json:2:"), HasSubstr("expected a number that is not so large")));
  EXPECT_THAT(mistakes_in("{\"x\": 1, \"x\": 2}"), HasSubstr("the key 'x' occurs twice"));
  EXPECT_THAT(mistakes_in(std::string(100'000, '[')), HasSubstr("nested more than 64 deep"));
}

TEST(TruthFile, TellsThePathOfWhatIsWrong) {
  const struct {
    std::string text;
    const char* expected;
  } cases[] = {
      {"[]", "t.json: found a list, expected an object with size_px"},
      {"{}", "/size_px: found nothing, expected the picture's width and height"},
      {annotation("[]", "null", R"("size_px": [0, 480], "tolerance_px": 1)"),
       "/size_px/0: found 0, expected"},
      {annotation("[]", "null", R"("size_px": [64.5, 480], "tolerance_px": 1)"), "/size_px: "},
      {annotation("[]", "null", R"("size_px": [64, 48])"),
       "found neither tolerance_px and tolerance_mm, expected one of them"},
      {annotation("[]", "null", R"("size_px": [64, 48], "tolerance_px": 1, "tolerance_mm": 1)"),
       "found both tolerance_px and tolerance_mm"},
      {annotation("[]", "null", R"("size_px": [64, 48], "tolerance_px": 0)"), "/tolerance_px: "},
      {annotation("[]", "null", R"("media": 7, "size_px": [64, 48], "tolerance_px": 1)"),
       "/media: found 7, expected text"},
      {annotation("[]", "null",
                  R"("size_px": [9, 9], "tolerance_px": 1, "field_corners_px": [[1, 2]])"),
       "/field_corners_px: found a list, expected four corners"},
      {annotation("[]", "null", R"("size_px": [9, 9], "tolerance_px": 1,
                  "field_corners_px": [[0, 0], [0, 9], [9, 9], [9, 0]])"),
       "/field_corners_px: the corners run counter-clockwise"},
      {annotation("7"), "/robots: found 7, expected a list of robots"},
      {annotation("[7]"), "/robots/0: found 7, expected an object"},
      {annotation(R"([{"team": "green", "x": 1, "y": 2}])"),
       "/robots/0/team: found 'green', expected blue or yellow"},
      {annotation(R"([{"team": "blue"}])"), "/robots/0: has no place, expected x and y"},
      {annotation(R"([{"team": "blue", "x": 1}])"),
       "/robots/0/y: found nothing, expected a number"},
      {annotation(R"([{"team": "blue", "x": 1e300, "y": 0}])"), "/robots/0/x: found 1e+300"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "id": 1.5}])"), "/robots/0/id: found 1.5"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "id": -2}])"), "/robots/0/id: found -2"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "player_colors": ["pink"]}])"),
       "/robots/0/player_colors/0: found 'pink', expected a colour of the palette (known: orange, "
       "blue"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "tags": [{"color": "background",
                  "x": 1, "y": 1}]}])"),
       "/robots/0/tags/0/color: found 'background', expected a colour"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "tags": [5]}])"),
       "/robots/0/tags/0: found 5, expected an object"},
      {annotation(R"([{"team": "blue", "x": 1, "y": 2, "heading_deg": "north"}])"),
       "/robots/0/heading_deg: found 'north', expected a number"},
      {annotation("[]", "[]"), "/ball: found a list, expected an object with x and y, or null"},
      {R"({"size_px": [9, 9], "tolerance_px": 1, "robots": []})",
       "/ball: found nothing, expected the ball, or null"},
      {R"({"size_px": [9, 9], "tolerance_px": 1, "frames": 1})", "/frames: found 1"},
      {R"({"size_px": [9, 9], "tolerance_px": 1, "frames": [1]})", "/frames/0: found 1"},
      {R"({"size_px": [9, 9], "tolerance_px": 1, "frames": [{"frame": -1}]})",
       "/frames/0/frame: found -1, expected the frame's number"},
      {R"({"size_px": [9, 9], "tolerance_px": 1, "frames": [{"frame": 1, "ball": null,
          "robots": []}, {"frame": 1, "ball": null, "robots": []}]})",
       "/frames/1/frame: frame 1 is listed twice"},
  };
  for (const auto& c : cases) EXPECT_THAT(mistakes_in(c.text), HasSubstr(c.expected)) << c.text;
}

TEST(TruthFile, ReportsEveryMistakeButNotWithoutEnd) {
  EXPECT_THAT(mistakes_in(annotation(R"([{"team": "x", "x": 1, "y": 2}, {"team": "blue"}])")),
              AllOf(HasSubstr("/robots/0/team"), HasSubstr("/robots/1: ")));
  std::string many = "[0";
  for (int i = 1; i < 200; ++i) many += ", " + std::to_string(i);
  try {
    parse(annotation(many + "]"));
    ADD_FAILURE() << "expected mistakes";
  } catch (const ConfigError& e) {
    EXPECT_LE(e.mistakes().size(), 20u);
  }
  for (int i = 0; i < 100; ++i) many += ", 0";
  EXPECT_THAT(mistakes_in(annotation(many + "]")), HasSubstr("found 300 robots in one frame"));
}

TEST(TruthFile, AFileThatCannotBeReadIsNamed) {
  const Palette palette = Palette::standard();
  const auto message = [&](const std::filesystem::path& file) -> std::string {
    try {
      load_truth(file, palette);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no mistake";
  };
  EXPECT_THAT(message("/no/such/truth.json"), HasSubstr("/no/such/truth.json: no such file"));
  EXPECT_THAT(message(std::filesystem::temp_directory_path()), HasSubstr("found a folder"));
}

}  // namespace
}  // namespace maggic
