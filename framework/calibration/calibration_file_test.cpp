#include "calibration/calibration_file.hpp"

#include <cctype>
#include <sstream>

#include <gmock/gmock.h>

#include "maggic/document.hpp"

namespace maggic::calibration {
namespace {

using ::testing::StartsWith;

CalibrationNumbers everything() {
  CalibrationNumbers numbers;
  numbers.heading = {"Written by a test.", "From nowhere."};
  numbers.segmenter = "hue_pivots";
  numbers.segmenter_yaml = "gray_threshold: 30   # given\npivots:   # hues\n  red: 252   # seen\n";
  numbers.field = FieldNumbers{.corners_px = {{{1.25, 2}, {99, 2.04}, {98, 70}, {-3, 71}}},
                               .corners_comment = "From 9 lines.",
                               .image_size_px = {100, 80},
                               .lens_k1 = -0.12345,
                               .lens_comment = "bends lines"};
  numbers.blobs = BlobNumbers{149.6, "a third", 8000.4, "three times"};
  return numbers;
}

const Node* find(const Node& node, std::initializer_list<std::string_view> path) {
  const Node* at = &node;
  for (const std::string_view key : path) at = at != nullptr ? at->find(key) : nullptr;
  return at;
}

TEST(CalibrationFile, IsYamlWithEveryNumber) {
  const Node node = parse_document(to_calibration_yaml(everything()), "calibration");
  EXPECT_EQ(find(node, {"segmenter", "hue_pivots", "gray_threshold"})->scalar, "30");
  EXPECT_EQ(find(node, {"segmenter", "hue_pivots", "pivots", "red"})->scalar, "252");
  const Node* corners = find(node, {"field", "corners_px"});
  ASSERT_NE(corners, nullptr);
  ASSERT_EQ(corners->items.size(), 4u);
  EXPECT_EQ(corners->items[1].items[0].scalar, "99.0");
  EXPECT_EQ(corners->items[3].items[0].scalar, "-3.0");
  EXPECT_EQ(find(node, {"field", "image_size_px"})->items[1].scalar, "80");
  EXPECT_EQ(find(node, {"field", "lens", "k1"})->scalar, "-0.1235");
  EXPECT_EQ(find(node, {"blobs", "min_area_mm2"})->scalar, "150");
  EXPECT_EQ(find(node, {"blobs", "max_area_mm2"})->scalar, "8000");
}

TEST(CalibrationFile, EveryNumberHasAComment) {
  std::istringstream text(to_calibration_yaml(everything()));
  std::string before;
  int numbers = 0;
  for (std::string line; std::getline(text, line); before = line) {
    const std::size_t comment = line.find('#');
    const std::string_view yaml = std::string_view(line).substr(0, comment);
    if (yaml.find_first_of("0123456789", std::min(yaml.find(':'), yaml.size())) ==
        std::string_view::npos) {
      continue;
    }
    ++numbers;
    EXPECT_TRUE(comment != std::string::npos || before.find("  #") == 0) << line;
  }
  EXPECT_EQ(numbers, 8);
}

TEST(CalibrationFile, BeginsWithItsHeading) {
  EXPECT_THAT(to_calibration_yaml(everything()),
              StartsWith("# Written by a test.\n# From nowhere."));
}

TEST(CalibrationFile, LeavesOutWhatIsNotKnown) {
  CalibrationNumbers numbers = everything();
  numbers.field.reset();
  numbers.blobs.reset();
  const Node node = parse_document(to_calibration_yaml(numbers), "calibration");
  EXPECT_EQ(node.find("field"), nullptr);
  EXPECT_EQ(node.find("blobs"), nullptr);
  EXPECT_NE(node.find("segmenter"), nullptr);
}

}  // namespace
}  // namespace maggic::calibration
