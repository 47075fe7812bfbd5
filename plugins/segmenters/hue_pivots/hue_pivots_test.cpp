#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "maggic/config_error.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

// Sanitizer builds run 20 times slower and look for memory errors: every 15th red does there, both
// ends included.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kRedStep = 15;
#else
constexpr int kRedStep = 1;
#endif

using ::testing::HasSubstr;
using ::testing::Not;
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

std::string explanation(const Segmenter& segmenter, Rgb original, Rgb normalized) {
  return dynamic_cast<const ColorSegmenter&>(segmenter).explain(
      {{&original.b, 1}, {&original.g, 1}, {&original.r, 1}},
      {{&normalized.b, 1}, {&normalized.g, 1}, {&normalized.r, 1}});
}

std::string explanation(const Segmenter& segmenter, Rgb color) {
  return explanation(segmenter, color, color);
}

StagePtr<Segmenter> hue_pivots(std::string_view yaml) {
  return testing::make<Segmenter>("hue_pivots", yaml);
}

Label standard(std::string_view name) { return testing::standard_palette().find(name).value(); }

std::string mistakes_of(std::string_view yaml) {
  try {
    hue_pivots(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

/// Segments all 2^24 colours and hands each label over with OpenCV's hue, saturation and value.
template <class F>
void for_every_color(const Segmenter& stage, F visit) {
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(stage);
  constexpr int kBatch = 256 * 256;
  cv::Mat3b bgr(1, kBatch);
  cv::Mat3b hsv;
  std::vector<std::uint8_t> b(kBatch);
  std::vector<std::uint8_t> g(kBatch);
  std::vector<std::uint8_t> r(kBatch);
  std::vector<Label> labels(kBatch);
  for (int red = 0; red < 256; red += kRedStep) {
    for (int i = 0; i < kBatch; ++i) {
      b[i] = static_cast<std::uint8_t>(i & 255);
      g[i] = static_cast<std::uint8_t>(i >> 8);
      r[i] = static_cast<std::uint8_t>(red);
      bgr(0, i) = {b[i], g[i], r[i]};
    }
    cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV_FULL);
    segmenter.segment({b, g, r}, {b, g, r}, labels);
    for (int i = 0; i < kBatch; ++i) visit(bgr(0, i), hsv(0, i), labels[i]);
  }
}

bool is_gray(const cv::Vec3b& bgr) { return bgr[0] == bgr[1] && bgr[1] == bgr[2]; }

/// Eight colours share the hues out by three bits of the hue, so a label tells these bits.
std::string pivots_by_bits(int shift) {
  constexpr std::array<const char*, 8> kColors{"orange", "blue",    "yellow", "red",
                                               "green",  "magenta", "cyan",   "purple"};
  std::string yaml = "{gray_threshold: 0, pivots: {";
  for (int bits = 0; bits < 8; ++bits) {
    std::string hues;
    for (int hue = 0; hue < 256; ++hue) {
      if ((hue >> shift & 7) == bits) hues += fmt::format("{}, ", hue);
    }
    if (!hues.empty()) yaml += fmt::format("{}: [{}], ", kColors[bits], hues);
  }
  return yaml + "}}";
}

TEST(HuePivots, TakesOpenCvsFullRangeHueBitForBitForEveryColor) {
  for (const int shift : {0, 3, 6}) {
    const auto stage = hue_pivots(pivots_by_bits(shift));
    std::size_t wrong = 0;
    for_every_color(*stage, [&](const cv::Vec3b& bgr, const cv::Vec3b& hsv, Label label) {
      const int expected = is_gray(bgr) ? kBackground : 1 + (hsv[0] >> shift & 7);
      wrong += label != expected;
    });
    EXPECT_EQ(wrong, 0U) << "bits from " << shift;
  }
}

TEST(HuePivots, GivesTheDefaultPivotNearestToOpenCvsHueForEveryColor) {
  std::array<Label, 256> nearest;
  for (int hue = 0; hue < 256; ++hue) {
    int best = 256;
    for (const auto& [name, pivot] :
         std::initializer_list<std::pair<const char*, int>>{{"red", 0},
                                                            {"orange", 7},
                                                            {"yellow", 43},
                                                            {"green", 97},
                                                            {"cyan", 140},
                                                            {"blue", 151},
                                                            {"magenta", 235}}) {
      const int around = std::min((hue - pivot) & 255, (pivot - hue) & 255);
      if (around < best) nearest[hue] = standard(name);
      best = std::min(best, around);
    }
  }
  const auto stage = hue_pivots("gray_threshold: 0");
  std::size_t wrong = 0;
  for_every_color(*stage, [&](const cv::Vec3b& bgr, const cv::Vec3b& hsv, Label label) {
    wrong += label != (is_gray(bgr) ? kBackground : nearest[hsv[0]]);
  });
  EXPECT_EQ(wrong, 0U);
}

TEST(HuePivots, ExcludesRectanglesOfOpenCvsHueSaturationAndValue) {
  const auto stage = hue_pivots(
      "{gray_threshold: 0, pivots: {red: 0}, exclude: [{hue: [250, 10], value: [20, 90]}, "
      "{hue: [100, 140], saturation: [0, 60]}, "
      "{hue: [30, 90], value: [100, 200], saturation: [33, 77]}]}");
  std::size_t wrong = 0;
  for_every_color(*stage, [&](const cv::Vec3b& bgr, const cv::Vec3b& hsv, Label label) {
    const auto [hue, saturation, value] = std::tuple{hsv[0], hsv[1], hsv[2]};
    const bool excluded = ((hue >= 250 || hue <= 10) && value >= 20 && value <= 90) ||
                          (hue >= 100 && hue <= 140 && saturation <= 60) ||
                          (hue >= 30 && hue <= 90 && value >= 100 && value <= 200 &&
                           saturation >= 33 && saturation <= 77);
    wrong += label != (is_gray(bgr) || excluded ? kBackground : standard("red"));
  });
  EXPECT_EQ(wrong, 0U);
}

TEST(HuePivots, LabelsABoxOfColorsWhereAllHaveOneLabel) {
  const auto stage = hue_pivots("gray_threshold: 20");
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*stage);
  const ColorBox reds{{0, 7}, {0, 7}, {200, 207}};
  const ColorBox grays{{100, 110}, {100, 110}, {100, 110}};
  const ColorBox red_to_yellow{{0, 7}, {0, 207}, {200, 207}};
  EXPECT_EQ(segmenter.label_of(reds, reds), standard("red"));
  EXPECT_EQ(segmenter.label_of(reds, grays), kBackground) << "gray once normalised";
  EXPECT_EQ(segmenter.label_of(red_to_yellow, red_to_yellow), std::nullopt);
}

TEST(HuePivots, LabelsABoxOfColorsThatOneRectangleExcludes) {
  const auto stage =
      hue_pivots("{gray_threshold: 20, exclude: [{hue: [250, 5], value: [0, 210]}]}");
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*stage);
  const ColorBox dark_reds{{0, 7}, {0, 7}, {200, 207}};
  const ColorBox reds{{0, 7}, {0, 7}, {208, 215}};
  const ColorBox bright_reds{{0, 7}, {0, 7}, {216, 223}};
  EXPECT_EQ(segmenter.label_of(dark_reds, dark_reds), kBackground);
  EXPECT_EQ(segmenter.label_of(reds, reds), std::nullopt);
  EXPECT_EQ(segmenter.label_of(bright_reds, bright_reds), standard("red"));
}

TEST(HuePivots, LetsAColorHaveSeveralPivots) {
  const auto stage = hue_pivots("pivots: {blue: [0, 170], green: 85}");
  EXPECT_EQ(label_of(*stage, {255, 0, 0}), standard("blue"));
  EXPECT_EQ(label_of(*stage, {0, 0, 255}), standard("blue"));
  EXPECT_EQ(label_of(*stage, {0, 255, 0}), standard("green"));
}

TEST(HuePivots, GivesTheFirstListedOfTwoPivotsEquallyNear) {
  // Pure green has hue 85.
  EXPECT_EQ(label_of(*hue_pivots("pivots: {red: 80, blue: 90}"), {0, 255, 0}), standard("red"));
  EXPECT_EQ(label_of(*hue_pivots("pivots: {blue: 90, red: 80}"), {0, 255, 0}), standard("blue"));
}

TEST(HuePivots, MeasuresHueAroundTheCircle) {
  EXPECT_EQ(label_of(*hue_pivots("pivots: {magenta: 250, orange: 10}"), {255, 0, 0}),
            standard("magenta"));
}

TEST(HuePivots, FiltersGrayByTheNormalizedColorBoundIncluded) {
  const auto stage = hue_pivots("gray_threshold: 30");
  EXPECT_EQ(label_of(*stage, {255, 0, 0}, {130, 100, 100}), kBackground);
  EXPECT_EQ(label_of(*stage, {101, 100, 100}, {131, 100, 100}), standard("red"));
}

TEST(HuePivots, TakesTheHueOfTheColorAskedFor) {
  const Rgb red{255, 0, 0};
  const Rgb blue{0, 0, 255};
  EXPECT_EQ(label_of(*hue_pivots("hue_of: original"), red, blue), standard("red"));
  EXPECT_EQ(label_of(*hue_pivots("hue_of: normalized"), red, blue), standard("blue"));
}

TEST(HuePivots, TakesAColorWithoutHueForBackground) {
  EXPECT_EQ(label_of(*hue_pivots("gray_threshold: 0"), {80, 80, 80}, {90, 80, 80}), kBackground);
}

TEST(HuePivots, MakesEverythingBackgroundAtTheHighestThreshold) {
  EXPECT_EQ(label_of(*hue_pivots("gray_threshold: 255"), {255, 0, 0}), kBackground);
}

TEST(HuePivots, RefusesOnePivotForTwoColors) {
  EXPECT_THAT(mistakes_of("pivots: {red: 0, magenta: [235, 0]}"),
              HasSubstr("found hue 0 for both red and magenta"));
}

TEST(HuePivots, RefusesSpansThatRunBackwardsUnlessTheyAreHues) {
  EXPECT_THAT(mistakes_of("exclude: [{hue: [0, 9], value: [90, 20]}]"),
              HasSubstr("found [90, 20], expected the smaller value first"));
  EXPECT_NE(mistakes_of("exclude: [{value: [0, 20]}]"), "none");
  EXPECT_NE(mistakes_of("exclude: [{hue: [0, 9, 20]}]"), "none");
  EXPECT_EQ(mistakes_of("exclude: [{hue: [250, 9]}]"), "none");
}

TEST(HuePivots, SaysWhichPivotIsNearestAndWhichIsNext) {
  EXPECT_EQ(
      explanation(*hue_pivots("pivots: {red: 3, orange: 20}"), {255, 0, 0}),
      "hue 0 of the original colour is nearest to red's pivot 3 (3 away); next is orange's 20 "
      "(20 away)");
}

TEST(HuePivots, SaysWhatTheGrayFilterTakesAway) {
  const std::string why = explanation(*hue_pivots("gray_threshold: 60"), {255, 0, 0}, {62, 50, 50});
  EXPECT_THAT(why, StartsWith("gray: channels of the normalized colour spread over 12 steps, "
                              "gray_threshold is 60\nwithout the gray filter: hue 0"));
}

TEST(HuePivots, SaysWhichRectangleExcludesAColor) {
  const auto stage = hue_pivots(
      "exclude: [{hue: [90, 99]}, {hue: [250, 10], value: [0, 120], saturation: [200, 255]}]");
  EXPECT_THAT(explanation(*stage, {100, 0, 0}),
              StartsWith("excluded: hue 0, saturation 255, value 100 lie in exclude[1] (hue [250, "
                         "10], saturation [200, 255], value [0, 120])\nwithout that: hue 0"));
  EXPECT_THAT(explanation(*stage, {121, 0, 0}), Not(HasSubstr("excluded")));
}

TEST(HuePivots, SaysThatAColorHasNoHue) {
  EXPECT_THAT(explanation(*hue_pivots("gray_threshold: 0"), {80, 80, 80}, {90, 80, 80}),
              HasSubstr("no hue"));
}

TEST(HuePivots, LeavesOutDefaultPivotsThePaletteLacks) {
  Palette palette;
  const Label blue = palette.set("blue", {0, 0, 255});
  testing::RecordingReporter reporter;
  const auto stage = testing::registry().create(StageKind::kSegmenter, "hue_pivots");
  configure_stage(*stage, "", palette, reporter);
  EXPECT_EQ(label_of(dynamic_cast<const Segmenter&>(*stage), {255, 0, 0}), blue);
}

TEST(HuePivots, RefusesAPaletteWithoutAnyDefaultPivot) {
  Palette palette;
  palette.set("purple", {128, 0, 255});
  testing::RecordingReporter reporter;
  const auto stage = testing::registry().create(StageKind::kSegmenter, "hue_pivots");
  EXPECT_THROW(configure_stage(*stage, "", palette, reporter), std::invalid_argument);
}

}  // namespace
}  // namespace maggic
