#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/config_error.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

struct Rgb {
  std::uint8_t r, g, b;
};

Label label_of(const Segmenter& segmenter, Rgb original, Rgb normalized) {
  Label label = 99;
  dynamic_cast<const ColorSegmenter&>(segmenter).segment(
      {{&original.b, 1}, {&original.g, 1}, {&original.r, 1}},
      {{&normalized.b, 1}, {&normalized.g, 1}, {&normalized.r, 1}}, {&label, 1});
  return label;
}

Label label_of(const Segmenter& segmenter, Rgb color) { return label_of(segmenter, color, color); }

std::string explanation(const Segmenter& segmenter, Rgb color) {
  const ColorBatch one{{&color.b, 1}, {&color.g, 1}, {&color.r, 1}};
  return dynamic_cast<const ColorSegmenter&>(segmenter).explain(one, one);
}

std::vector<Label> claimants(const Segmenter& segmenter, Rgb color) {
  const ColorBatch one{{&color.b, 1}, {&color.g, 1}, {&color.r, 1}};
  return dynamic_cast<const ColorSegmenter&>(segmenter).claimants(one, one);
}

Label standard(std::string_view name) { return testing::standard_palette().find(name).value(); }

std::string mistakes_of(std::string_view yaml) {
  try {
    testing::make<Segmenter>("yuv_boxes", yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

constexpr const char* kWhole = "{y: [0, 255], u: [0, 255], v: [0, 255]}";

TEST(YuvBoxes, HoldsBothBoundsOfABox) {
  // Red (255, 0, 0) is Y 76, U 85, V 255; green (0, 255, 0) is Y 149, U 43, V 23.
  const auto exactly =
      testing::make<Segmenter>("yuv_boxes",
                               "boxes: {red: {y: [76, 76], u: [85, 85], v: [255, 255]}, "
                               "green: {y: [149, 149], u: [43, 43], v: [23, 23]}}");
  EXPECT_EQ(label_of(*exactly, {255, 0, 0}), standard("red"));
  EXPECT_EQ(label_of(*exactly, {0, 255, 0}), standard("green"));
  EXPECT_EQ(label_of(*exactly, {250, 0, 0}), kBackground);
}

TEST(YuvBoxes, GivesTheFirstListedBoxThatHoldsTheColor) {
  const auto both = testing::make<Segmenter>(
      "yuv_boxes", std::string("boxes: {yellow: ") + kWhole + ", blue: " + kWhole + "}");
  EXPECT_EQ(label_of(*both, {0, 0, 255}), standard("yellow"));
}

TEST(YuvBoxes, LabelsABoxOfColorsWhereAllHaveOneLabel) {
  const auto stage = testing::make<Segmenter>(
      "yuv_boxes", "{gray_threshold: 20, boxes: {red: {y: [0, 100], u: [0, 255], v: [200, 255]}}}");
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*stage);
  const ColorBox reds{{0, 7}, {0, 7}, {200, 207}};
  const ColorBox blues{{200, 207}, {0, 7}, {0, 7}};
  const ColorBox grays{{100, 110}, {100, 110}, {100, 110}};
  const ColorBox dark_to_red{{0, 7}, {0, 7}, {64, 207}};
  EXPECT_EQ(segmenter.label_of(reds, reds), standard("red"));
  EXPECT_EQ(segmenter.label_of(blues, blues), kBackground) << "in no box";
  EXPECT_EQ(segmenter.label_of(grays, reds), kBackground) << "gray before it was normalised";
  EXPECT_EQ(segmenter.label_of(dark_to_red, dark_to_red), std::nullopt);
}

TEST(YuvBoxes, BoxesTheNormalizedColor) {
  const auto red = testing::make<Segmenter>(
      "yuv_boxes", "boxes: {red: {y: [76, 76], u: [85, 85], v: [255, 255]}}");
  EXPECT_EQ(label_of(*red, {90, 0, 0}, {255, 0, 0}), standard("red"));
  EXPECT_EQ(label_of(*red, {255, 0, 0}, {90, 0, 0}), kBackground);
}

TEST(YuvBoxes, FiltersGrayByTheOriginalColor) {
  const auto filtered = testing::make<Segmenter>(
      "yuv_boxes", std::string("{gray_threshold: 20, boxes: {red: ") + kWhole + "}}");
  EXPECT_EQ(label_of(*filtered, {120, 100, 100}, {255, 0, 0}), kBackground);
  EXPECT_EQ(label_of(*filtered, {121, 100, 100}, {50, 50, 50}), standard("red"));
}

TEST(YuvBoxes, FiltersNoGrayUnlessAskedTo) {
  const auto open =
      testing::make<Segmenter>("yuv_boxes", std::string("boxes: {red: ") + kWhole + "}");
  EXPECT_EQ(label_of(*open, {100, 100, 100}), standard("red"));
}

TEST(YuvBoxes, ConvertsEveryColorAsTheIntegerFormulasSay) {
  const auto odd =
      testing::make<Segmenter>("yuv_boxes",
                               "boxes: {red: {y: [60, 131], u: [77, 150], v: [101, 202]}, "
                               "green: {y: [33, 190], u: [20, 99], v: [30, 120]}, "
                               "blue: {y: [1, 90], u: [129, 254], v: [3, 127]}}");
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*odd);
  constexpr std::size_t kBatch = 256 * 256;
  std::vector<std::uint8_t> b(kBatch);
  std::vector<std::uint8_t> g(kBatch);
  for (std::size_t i = 0; i < kBatch; ++i) {
    b[i] = static_cast<std::uint8_t>(i & 255);
    g[i] = static_cast<std::uint8_t>(i >> 8);
  }
  std::vector<Label> labels(kBatch);
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
  std::size_t wrong = 0;
  for (int red = 0; red < 256; ++red) {
    const std::vector<std::uint8_t> r(kBatch, static_cast<std::uint8_t>(red));
    segmenter.segment({b, g, r}, {b, g, r}, labels);
    for (std::size_t i = 0; i < kBatch; ++i) {
      const int y = (306 * red + 601 * g[i] + 117 * b[i]) >> 10;
      const int u = ((-172 * red - 340 * g[i] + 512 * b[i]) >> 10) + 128;
      const int v = ((512 * red - 419 * g[i] - 83 * b[i]) >> 10) + 128;
      Label expected = kBackground;
      if (within(y, 60, 131) && within(u, 77, 150) && within(v, 101, 202)) {
        expected = 4;
      } else if (within(y, 33, 190) && within(u, 20, 99) && within(v, 30, 120)) {
        expected = 5;
      } else if (within(y, 1, 90) && within(u, 129, 254) && within(v, 3, 127)) {
        expected = 2;
      }
      wrong += labels[i] != expected;
    }
  }
  EXPECT_EQ(wrong, 0U);
}

// Red (255, 0, 0) is Y 76, U 85, V 255.
TEST(YuvBoxes, SaysWhichSideOfTheNearestBoxMisses) {
  const auto stage =
      testing::make<Segmenter>("yuv_boxes",
                               "boxes: {green: {y: [0, 255], u: [0, 60], v: [0, 90]}, "
                               "red: {y: [80, 200], u: [0, 83], v: [0, 255]}}");
  EXPECT_EQ(explanation(*stage, {255, 0, 0}),
            "YUV 76 85 255 of the normalized colour is in no box; nearest is the box of red: Y 76 "
            "is 4 below its 80 … 200, U 85 is 2 above its 0 … 83");
}

TEST(YuvBoxes, SaysWhichBoxesHoldAColor) {
  const auto stage = testing::make<Segmenter>(
      "yuv_boxes", std::string("boxes: {yellow: ") + kWhole + ", blue: " + kWhole +
                       ", red: {y: [0, 70], u: [0, 255], v: [0, 255]}}");
  EXPECT_THAT(explanation(*stage, {255, 0, 0}),
              HasSubstr("is in the boxes of yellow, blue: the first listed wins; next is red: Y 76 "
                        "is 6 above its 0 … 70"));
}

TEST(YuvBoxes, SaysWhatTheGrayFilterTakesAway) {
  const auto stage = testing::make<Segmenter>(
      "yuv_boxes", std::string("{gray_threshold: 20, boxes: {red: ") + kWhole + "}}");
  EXPECT_THAT(explanation(*stage, {120, 100, 100}),
              StartsWith("gray: channels of the original colour spread over 20 steps, "
                         "gray_threshold is 20\nwithout the gray filter: YUV"));
}

TEST(YuvBoxes, ListsTheColorsThatClaimAColorTheWinnerFirst) {
  const auto stage = testing::make<Segmenter>(
      "yuv_boxes", std::string("{gray_threshold: 9, boxes: {yellow: ") + kWhole +
                       ", green: {y: [0, 9], u: [0, 255], v: [0, 255]}, blue: " + kWhole + "}}");
  EXPECT_THAT(claimants(*stage, {255, 0, 0}), ElementsAre(standard("yellow"), standard("blue")));
  EXPECT_THAT(claimants(*stage, {105, 100, 100}), IsEmpty());
}

TEST(YuvBoxes, RefusesBoxesThatHoldNothing) {
  EXPECT_THAT(mistakes_of("boxes: {red: {y: [9, 3], u: [0, 255], v: [0, 255]}}"),
              HasSubstr("found [9, 3], expected the smaller value first"));
}

TEST(YuvBoxes, RefusesBoxesWithoutAllThreeAxes) {
  EXPECT_THAT(mistakes_of("boxes: {red: {y: [0, 255], u: [0, 255]}}"), HasSubstr("v"));
  EXPECT_THAT(mistakes_of("boxes: {red: {y: [0], u: [0, 255], v: [0, 255]}}"), HasSubstr("y"));
  EXPECT_NE(mistakes_of(""), "none");
}

TEST(YuvBoxes, TakesAtMostEightColors) {
  std::string yaml = "boxes: {";
  for (const char* color :
       {"orange", "blue", "yellow", "red", "green", "magenta", "cyan", "purple"}) {
    yaml += std::string(color) + ": " + kWhole + ", ";
  }
  EXPECT_EQ(mistakes_of(yaml + "}"), "none");
  EXPECT_NE(mistakes_of(yaml + "brown: " + kWhole + "}"), "none");
}

}  // namespace
}  // namespace maggic
