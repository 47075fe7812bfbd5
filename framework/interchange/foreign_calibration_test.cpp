#include "maggic/foreign_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "maggic/field.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kSession = "Maggic\n17 82\n78\n-1 4\n43 3\n97 5\n140 7\n151 2\n235 6\n";
constexpr const char* kLimits =
    R"({"point1": {"x": 65, "y": 37}, "point2": {"x": 54, "y": 443},
        "point3": {"x": 576, "y": 448}, "point4": {"x": 575, "y": 52}})";

/// A node of the XML: name, then Y, U, V smallest and largest.
std::string box(std::string_view name, std::array<int, 6> b) {
  return fmt::format(
      "<{0}>\n  <YMAX>{2}</YMAX>\n  <UMAX>{4}</UMAX>\n  <VMAX>{6}</VMAX>\n"
      "  <YMIN>{1}</YMIN>\n  <UMIN>{3}</UMIN>\n  <VMIN>{5}</VMIN></{0}>\n",
      name, b[0], b[1], b[2], b[3], b[4], b[5]);
}
std::string xml(std::string_view nodes) {
  return fmt::format("<?xml version=\"1.0\"?>\n<opencv_storage>\n{}</opencv_storage>\n", nodes);
}

ImportedCalibration imported(std::string_view text,
                             std::optional<cv::Size> image_size_px = std::nullopt) {
  const ForeignCalibration calibration = parse_foreign_calibration(text, "there/file");
  return import_calibrations({&calibration, 1}, image_size_px);
}

Node document_of(std::string_view text) {
  return parse_document(imported(text).yaml, "imported.yaml");
}

const Node& at(const Node& root, std::initializer_list<std::string_view> path) {
  const Node* node = &root;
  for (const std::string_view key : path) {
    node = node->find(key);
    if (node == nullptr) throw std::out_of_range(std::string(key));
  }
  return *node;
}

std::string mistakes_of(std::string_view text) {
  try {
    imported(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(ForeignCalibration, TakesThresholdAndPivotsOfASession) {
  const Node root = document_of(kSession);
  const Node& plugin = at(root, {"segmenter", "hue_pivots"});
  EXPECT_EQ(at(plugin, {"gray_threshold"}).scalar, "78");
  EXPECT_EQ(at(plugin, {"hue_of"}).scalar, "original");
  EXPECT_EQ(at(plugin, {"pivots", "yellow"}).scalar, "43");
  EXPECT_EQ(at(plugin, {"pivots", "magenta"}).scalar, "235");
  EXPECT_EQ(at(plugin, {"pivots", "cyan"}).scalar, "140");
  EXPECT_EQ(at(plugin, {"pivots"}).entries.size(), 6U);
}

TEST(ForeignCalibration, TakesAHueOfMinusOneForTheLastOfTheCircle) {
  const ImportedCalibration session = imported(kSession);
  EXPECT_THAT(session.yaml, HasSubstr("red: 255"));
  EXPECT_THAT(session.yaml, HasSubstr("# file:4: hue -1, which is 255 on the circle"));
}

TEST(ForeignCalibration, SaysWhereEveryNumberCameFrom) {
  const ImportedCalibration session = imported(kSession);
  EXPECT_THAT(session.yaml, AllOf(HasSubstr("gray_threshold: 78"), HasSubstr("# file:3\n"),
                                  HasSubstr("# file:9\n")));
  EXPECT_THAT(session.notes, IsEmpty());
}

TEST(ForeignCalibration, GivesAColorAllItsHues) {
  const Node root = document_of("Maggic 0 255 20\n200 1\n10 1\n90 5\n");
  const Node& hues = at(root, {"segmenter", "hue_pivots", "pivots", "orange"});
  ASSERT_EQ(hues.items.size(), 2U);
  EXPECT_EQ(hues.items[0].scalar, "10");
  EXPECT_EQ(hues.items[1].scalar, "200");
}

TEST(ForeignCalibration, LeavesOutAPivotThatNeverWins) {
  const ImportedCalibration session = imported("Maggic 0 255 20\n10 4\n10 1\n90 5\n");
  EXPECT_THAT(session.yaml, AllOf(HasSubstr("orange: 10"), Not(HasSubstr("red:"))));
  EXPECT_THAT(session.notes,
              ElementsAre(HasSubstr("file:2: hue 10 is orange already, so its pivot for red")));
}

// What their program answers for a hue, from its own words: sorted pairs, the first nearest one.
int label_there(std::vector<std::pair<int, int>> pivots, int hue) {
  std::ranges::sort(pivots);
  int label = 0;
  int nearest = 1000;
  for (const auto& [pivot, of] : pivots) {
    const int distance =
        std::min({std::abs(pivot - hue), std::abs(256 + pivot - hue), std::abs(pivot - hue - 256)});
    if (distance < nearest) {
      nearest = distance;
      label = of;
    }
  }
  return label;
}

RC_GTEST_PROP(ForeignCalibrationProperty, EveryHueKeepsItsColorOrANoteSaysSo, ()) {
  const auto pivots = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-1, 256), rc::gen::inRange(1, 10))));
  std::string text = "Maggic\n0 255\n20\n";
  for (const auto& [hue, label] : pivots) text += fmt::format("{} {}\n", hue, label);
  const ImportedCalibration session = imported(text);
  const Node root = parse_document(session.yaml, "imported.yaml");
  const Palette palette = Palette::standard();
  std::vector<std::pair<int, int>> ours;  // hue, label, in the order hue_pivots goes through
  for (const Node::Entry& entry : at(root, {"segmenter", "hue_pivots", "pivots"}).entries) {
    const int label = palette.find(entry.key).value();
    if (entry.value.kind == Node::Kind::kScalar)
      ours.emplace_back(std::stoi(entry.value.scalar), label);
    for (const Node& hue : entry.value.items) ours.emplace_back(std::stoi(hue.scalar), label);
  }
  bool differs = false;
  for (int hue = 0; hue < 256; ++hue) {
    int label = 0;
    int nearest = 1000;
    for (const auto& [pivot, of] : ours) {
      const int straight = std::abs(pivot - hue);
      const int distance = std::min(straight, 256 - straight);
      if (distance >= nearest) continue;
      nearest = distance;
      label = of;
    }
    differs = differs || label != label_there(pivots, hue);
  }
  const bool said = std::ranges::any_of(session.notes, [](const std::string& note) {
    return note.find("equally near") != std::string::npos;
  });
  RC_ASSERT(differs == said);
}

TEST(ForeignCalibration, RefusesABrokenSessionWithItsPlace) {
  EXPECT_EQ(mistakes_of("Maggic\n17 82\n"),
            "there/file:3:1: found nothing, expected a gray threshold from 0 to 255");
  EXPECT_EQ(mistakes_of("Maggic\n17 82\n300\n"),
            "there/file:3:1: found '300', expected a gray threshold from 0 to 255");
  EXPECT_THAT(mistakes_of("Maggic 1 2 3\n7 x\n"),
              HasSubstr("there/file:2:3: found 'x', expected the hue's label: 1 orange"));
  EXPECT_THAT(mistakes_of("Maggic 1 2 3\n7 10\n"), HasSubstr("found '10'"));
  EXPECT_THAT(mistakes_of("Maggic 1 2 3\n-2 1\n"), HasSubstr("expected a hue from -1 to 255"));
  EXPECT_THAT(mistakes_of("Maggic 1 2 3\n7\n"),
              HasSubstr("found nothing, expected the hue's label"));
  EXPECT_THAT(mistakes_of("Maggic 1 2 3\n"), HasSubstr("found no hues"));
}

TEST(ForeignCalibration, TakesBoxesInTheOrderTheyAreTried) {
  const Node root =
      document_of(xml(box("Red", {1, 2, 3, 4, 5, 6}) + box("LightBlue", {0, 9, 0, 8, 0, 7}) +
                      box("Orange", {10, 20, 30, 40, 50, 60})));
  const Node& boxes = at(root, {"segmenter", "yuv_boxes", "boxes"});
  ASSERT_EQ(boxes.entries.size(), 3U);
  EXPECT_EQ(boxes.entries[0].key, "orange");
  EXPECT_EQ(boxes.entries[1].key, "red");
  EXPECT_EQ(boxes.entries[2].key, "cyan");
  EXPECT_EQ(at(boxes, {"orange", "y"}).items[0].scalar, "10");
  EXPECT_EQ(at(boxes, {"orange", "v"}).items[1].scalar, "60");
  EXPECT_EQ(at(root, {"segmenter", "yuv_boxes"}).find("gray_threshold"), nullptr);
}

TEST(ForeignCalibration, LowersTheGrayScaleByOneAsOursIsInclusive) {
  const std::string red = box("Red", {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(at(document_of(xml(red + "<GrayScale>35</GrayScale>")),
               {"segmenter", "yuv_boxes", "gray_threshold"})
                .scalar,
            "34");
  const ImportedCalibration none = imported(xml(red + "<GrayScale>0</GrayScale>"));
  EXPECT_THAT(none.yaml, Not(HasSubstr("gray_threshold")));
  EXPECT_THAT(none.notes, ElementsAre(HasSubstr("GrayScale 0 filters nothing")));
}

TEST(ForeignCalibration, LeavesOutBoxesThatHoldNothing) {
  const ImportedCalibration boxes =
      imported(xml(box("NoCOL", {}) + box("Red", {1, 2, 3, 4, 5, 6}) + box("Blue", {}) +
                   box("Green", {9, 3, 0, 9, 0, 9})));
  EXPECT_THAT(boxes.yaml,
              AllOf(HasSubstr("red:"), Not(HasSubstr("blue:")), Not(HasSubstr("green:"))));
  EXPECT_THAT(boxes.notes, ElementsAre(HasSubstr("Green has a smallest value above its largest"),
                                       HasSubstr("no box (all zeros) for Blue")));
}

TEST(ForeignCalibration, ReportsABoxTooMany) {
  std::string nodes;
  for (const char* name : {"Orange", "Blue", "Yellow", "Red", "Green", "Pink", "LightBlue",
                           "Purple", "Brown", "ColorStrange"}) {
    nodes += box(name, {0, 9, 0, 9, 0, 9});
  }
  const ImportedCalibration boxes = imported(xml(nodes));
  EXPECT_THAT(boxes.yaml, AllOf(HasSubstr("purple:"), Not(HasSubstr("brown:"))));
  EXPECT_THAT(boxes.notes, ElementsAre(HasSubstr("Brown is the ninth box"),
                                       HasSubstr("ColorStrange is no colour of ours")));
}

TEST(ForeignCalibration, TakesTheBackgroundsBoxOutOfTheOthersOrRefuses) {
  const std::string red = box("Red", {10, 90, 0, 255, 0, 255});
  const std::string trimmed = imported(xml(box("NoCOL", {0, 20, 0, 255, 0, 255}) + red)).yaml;
  EXPECT_THAT(trimmed, AllOf(HasSubstr("red: {y: [21, 90]"), HasSubstr("less NoCOL's box")));
  EXPECT_THAT(imported(xml(box("NoCOL", {80, 255, 0, 255, 0, 255}) + red)).yaml,
              HasSubstr("red: {y: [10, 79]"));
  EXPECT_THAT(imported(xml(box("NoCOL", {0, 5, 0, 255, 0, 255}) + red)).yaml,
              HasSubstr("red: {y: [10, 90]"));
  EXPECT_THAT(mistakes_of(xml(box("NoCOL", {0, 20, 0, 100, 0, 255}) + red)),
              HasSubstr("there/file:3:1: found a box for NoCOL that takes a piece out of Red's"));
  EXPECT_THAT(mistakes_of(xml(box("NoCOL", {30, 40, 0, 255, 0, 255}) + red)),
              HasSubstr("yuv_boxes has no box for background"));
  const ImportedCalibration covered =
      imported(xml(box("NoCOL", {0, 20, 0, 255, 0, 255}) + red + box("Blue", {0, 5, 0, 5, 0, 5})));
  EXPECT_THAT(covered.yaml, Not(HasSubstr("blue:")));
  EXPECT_THAT(covered.notes, ElementsAre(HasSubstr("Blue lies in NoCOL's box")));
}

TEST(ForeignCalibration, RefusesXmlOfAnotherShapeWithItsPlace) {
  const std::string red = box("Red", {1, 2, 3, 4, 5, 6});
  EXPECT_THAT(mistakes_of("<html></html>"),
              HasSubstr("there/file:1:1: found <html>, expected <opencv_storage>"));
  EXPECT_THAT(mistakes_of(xml(red + red)),
              HasSubstr("found a second <Red>, the first is in line 3"));
  EXPECT_THAT(mistakes_of(xml("<Rde></Rde>")),
              HasSubstr("there/file:3:1: unknown element 'Rde', did you mean 'Red'?"));
  EXPECT_THAT(mistakes_of(xml("<Red><YMIN>1</YMIN></Red>")),
              HasSubstr("found 1 of the six limits"));
  EXPECT_THAT(mistakes_of(xml("<Red><YMIN>1.5</YMIN></Red>")), HasSubstr("found '1.5', expected"));
  EXPECT_THAT(mistakes_of(xml("<Red><YMIN>256</YMIN></Red>")), HasSubstr("found '256', expected"));
  EXPECT_THAT(mistakes_of(xml("<Red><YMIN></YMIN></Red>")), HasSubstr("found nothing, expected"));
  EXPECT_THAT(mistakes_of(xml("<Red type_id=\"a\"></Red>")), HasSubstr("without attributes"));
  EXPECT_THAT(mistakes_of("<opencv_storage>" + red), HasSubstr("found the end of the file"));
  EXPECT_THAT(mistakes_of(xml(red) + "more"), HasSubstr("found 'more' behind </opencv_storage>"));
  EXPECT_THAT(mistakes_of("<!-- never ended"), HasSubstr("found no '-->'"));
  EXPECT_THAT(mistakes_of(xml("")), HasSubstr("found no box"));
  EXPECT_THAT(mistakes_of(xml(box("Red", {}))), HasSubstr("found no colour with a box"));
}

TEST(ForeignCalibration, PassesOverComments) {
  EXPECT_EQ(mistakes_of("<!-- a --><opencv_storage><!-- b -->" + box("Red", {1, 2, 3, 4, 5, 6}) +
                        "</opencv_storage><!-- c -->\n"),
            "none");
}

RC_GTEST_PROP(ForeignCalibrationProperty, CornersPutTheOutlineBehindTheGoalLines, ()) {
  // Any gentle perspective of the outline, in tenths of a pixel.
  const auto near = [](int value) { return value + *rc::gen::inRange(-300, 300) / 10.0; };
  const std::array<cv::Point2d, 4> outline{
      cv::Point2d(near(60), near(40)), cv::Point2d(near(60), near(440)),
      cv::Point2d(near(580), near(440)), cv::Point2d(near(580), near(40))};
  FieldLimits limits;
  limits.points_px = outline;
  const ForeignCalibration calibration = limits;
  const ImportedCalibration made = import_calibrations({&calibration, 1}, cv::Size(640, 480));
  const Node root = parse_document(made.yaml, "imported.yaml");
  FieldParameters field;
  for (const Node& corner : at(root, {"field", "corners_px"}).items) {
    field.corners_px.emplace_back(std::stod(corner.items[0].scalar),
                                  std::stod(corner.items[1].scalar));
  }
  const Field seen(field, {640, 480});
  const std::array<cv::Point2d, 4> expected{cv::Point2d(-850, 650), cv::Point2d(-850, -650),
                                            cv::Point2d(850, -650), cv::Point2d(850, 650)};
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d off = seen.to_field_mm(outline[i], 0.0) - expected[i];
    RC_ASSERT(std::hypot(off.x, off.y) < 0.5);
  }
}

TEST(ForeignCalibration, SaysThatCornersHoldForOnePictureSize) {
  const ImportedCalibration unknown = imported(kLimits);
  EXPECT_THAT(unknown.yaml, HasSubstr("# image_size_px:"));
  EXPECT_THAT(unknown.notes, ElementsAre(HasSubstr("does not say in which picture size")));
  const ImportedCalibration known = imported(kLimits, cv::Size(640, 480));
  EXPECT_EQ(at(parse_document(known.yaml, "y"), {"field", "image_size_px"}).items[1].scalar, "480");
  EXPECT_THAT(known.notes, IsEmpty());
}

TEST(ForeignCalibration, RefusesPointsThatMakeNoField) {
  EXPECT_THAT(mistakes_of(R"({"point1": {"x": 65, "y": 37}, "point2": {"x": 575, "y": 52},
                              "point3": {"x": 576, "y": 448}, "point4": {"x": 54, "y": 443}})"),
              HasSubstr("there/file:1:1: point1, point4, point3, point2 make no field"));
  EXPECT_THAT(mistakes_of(R"({"point1": {"x": 65}, "point2": 3, "point9": 1})"),
              AllOf(HasSubstr("found no y in point1"), HasSubstr("found no x in point2"),
                    HasSubstr("unknown key 'point9'"), HasSubstr("found no point3")));
  EXPECT_THAT(mistakes_of(R"({"point1": {"x": "65", "y": 1e9}})"),
              AllOf(HasSubstr("point1.x: found '65'"), HasSubstr("point1.y: found '1e9'")));
}

TEST(ForeignCalibration, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(mistakes_of(""), HasSubstr("there/file:1:1: found nothing, expected the start of"));
  EXPECT_THAT(mistakes_of("\n  segmenter: {}\n"), HasSubstr("there/file:2:3: found 'segmenter:'"));
  EXPECT_THAT(mistakes_of("MaggicVision 1 2"), HasSubstr("found 'MaggicVision'"));
  EXPECT_THAT(mistakes_of(std::string("\0\x01", 2)), HasSubstr("found '"));
}

TEST(ForeignCalibration, MergesKindsAndRefusesTwoOfOne) {
  const std::array<ForeignCalibration, 3> all{
      parse_foreign_calibration(kLimits, "fieldLimits.json"),
      parse_foreign_calibration(xml(box("Red", {1, 2, 3, 4, 5, 6})), "boxes.xml"),
      parse_foreign_calibration(kSession, "MaggicSegmentation.txt")};
  const ImportedCalibration merged = import_calibrations(all, std::nullopt);
  EXPECT_THAT(merged.found,
              ElementsAre(HasSubstr("6 pivots"), HasSubstr("1 boxes"), HasSubstr("four corners")));
  const Node root = parse_document(merged.yaml, "imported.yaml");
  EXPECT_EQ(at(root, {"segmenter"}).entries.size(), 2U);
  const std::array<ForeignCalibration, 2> twice{all[0], all[0]};
  EXPECT_THROW(import_calibrations(twice, std::nullopt), ConfigError);
}

}  // namespace
}  // namespace maggic
