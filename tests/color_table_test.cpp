/// Every normalizer and segmenter that ship, as one ColorTable, against the formulas written out
/// here once more in plain integers, colour by colour.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "maggic/color_table.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

// Sanitizers slow the reference down about tenfold: there every 13th colour is compared. 13 shares
// no factor with 256, so every value of every channel still comes up.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t kStep = 13;
#else
constexpr std::size_t kStep = 1;
#endif

using Color = std::array<int, 3>;  ///< B, G, R.

Color color_at(std::size_t index) {
  return {static_cast<int>(index & 255), static_cast<int>(index >> 8 & 255),
          static_cast<int>(index >> 16)};
}

std::size_t index_of(const Color& color) {
  return static_cast<std::size_t>(color[0] | color[1] << 8 | color[2] << 16);
}

int spread_of(const Color& color) {
  const auto [smallest, largest] = std::ranges::minmax(color);
  return largest - smallest;
}

/// floor(numerator / sqrt(squared)).
int divided_by_root(std::int64_t numerator, std::int64_t squared, double root) {
  auto q = static_cast<std::int64_t>(static_cast<double>(numerator) / root);
  while (q * q * squared > numerator * numerator) --q;
  while ((q + 1) * (q + 1) * squared <= numerator * numerator) ++q;
  return static_cast<int>(q);
}

Color normalized(const std::string& normalizer, const Color& color) {
  const int squared = color[0] * color[0] + color[1] * color[1] + color[2] * color[2];
  if (normalizer == "none" || squared == 0) return color;
  if (normalizer == "chromatic") {
    const int sum = color[0] + color[1] + color[2];
    return {255 * color[0] / sum, 255 * color[1] / sum, 255 * color[2] / sum};
  }
  Color result;
  const double root = std::sqrt(squared);
  for (std::size_t i = 0; i < 3; ++i) {
    const int numerator = normalizer == "vector" ? 255 * color[i] : color[i] * color[i];
    result[i] = divided_by_root(numerator, squared, root);
  }
  return result;
}

struct Pivot {
  const char* color;
  int hue;
};
constexpr std::array<Pivot, 7> kPivots{{{"red", 0},
                                        {"orange", 7},
                                        {"yellow", 43},
                                        {"green", 97},
                                        {"cyan", 140},
                                        {"blue", 151},
                                        {"magenta", 235}}};

Label label_of(const char* color) { return testing::standard_palette().find(color).value(); }

std::array<Label, 256> nearest_pivots() {
  std::array<Label, 256> labels;
  for (int hue = 0; hue < 256; ++hue) {
    const auto distance = [&](const Pivot& pivot) {
      return std::min((hue - pivot.hue) & 255, (pivot.hue - hue) & 255);
    };
    labels[static_cast<std::size_t>(hue)] =
        label_of(std::ranges::min_element(kPivots, {}, distance)->color);
  }
  return labels;
}

/// OpenCV's hue of every colour, at `index_of` it.
const std::vector<std::uint8_t>& opencv_hues() {
  static const std::vector<std::uint8_t> hues = [] {
    std::vector<std::uint8_t> all(ColorTable::kColors);
    cv::Mat3b bgr(1, 1 << 16);
    cv::Mat3b hsv;
    for (std::size_t first = 0; first < all.size(); first += 1 << 16) {
      for (int i = 0; i < bgr.cols; ++i) {
        const Color color = color_at(first + static_cast<std::size_t>(i));
        bgr(0, i) = cv::Vec3b(static_cast<std::uint8_t>(color[0]),
                              static_cast<std::uint8_t>(color[1]),
                              static_cast<std::uint8_t>(color[2]));
      }
      cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV_FULL);
      for (int i = 0; i < bgr.cols; ++i) all[first + static_cast<std::size_t>(i)] = hsv(0, i)[0];
    }
    return all;
  }();
  return hues;
}

constexpr int kThreshold = 25;

Label nearest_hue(const Color& normalized_color, const Color& hue_color) {
  static const std::array<Label, 256> labels = nearest_pivots();
  if (spread_of(normalized_color) <= kThreshold || spread_of(hue_color) == 0) return kBackground;
  return labels[opencv_hues()[index_of(hue_color)]];
}

struct Box {
  const char* color;
  std::array<int, 6> bounds;  ///< Y, U, V: min, max each.
};
constexpr std::array<Box, 3> kBoxes{{{"orange", {60, 220, 20, 120, 140, 255}},
                                     {"red", {20, 140, 70, 130, 160, 255}},
                                     {"blue", {10, 120, 140, 255, 40, 130}}}};
constexpr const char* kBoxesYaml =
    "{gray_threshold: 25, boxes: {orange: {y: [60, 220], u: [20, 120], v: [140, 255]}, "
    "red: {y: [20, 140], u: [70, 130], v: [160, 255]}, "
    "blue: {y: [10, 120], u: [140, 255], v: [40, 130]}}}";

Label first_box(const Color& original, const Color& normalized_color) {
  static const std::array<Label, 3> labels{label_of("orange"), label_of("red"), label_of("blue")};
  if (spread_of(original) <= kThreshold) return kBackground;
  const auto [b, g, r] = normalized_color;
  const int y = (306 * r + 601 * g + 117 * b) >> 10;
  const int u = ((-172 * r - 340 * g + 512 * b) >> 10) + 128;
  const int v = ((512 * r - 419 * g - 83 * b) >> 10) + 128;
  for (std::size_t i = 0; i < kBoxes.size(); ++i) {
    const std::array<int, 6>& in = kBoxes[i].bounds;
    if (y >= in[0] && y <= in[1] && u >= in[2] && u <= in[3] && v >= in[4] && v <= in[5]) {
      return labels[i];
    }
  }
  return kBackground;
}

Label label_in(const ColorTable& table, const Color& color) {
  return table(static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
               static_cast<std::uint8_t>(color[2]));
}

ColorTable compiled(const std::string& normalizer, const char* segmenter, const char* yaml) {
  const auto normalizer_stage = testing::make<Normalizer>(normalizer);
  const auto segmenter_stage = testing::make<Segmenter>(segmenter, yaml);
  return ColorTable::compile(dynamic_cast<const ColorNormalizer&>(*normalizer_stage),
                             dynamic_cast<const ColorSegmenter&>(*segmenter_stage),
                             testing::standard_palette().size());
}

class CompiledPair : public ::testing::TestWithParam<const char*> {};

TEST_P(CompiledPair, EqualsTheFormulasForEveryColor) {
  const std::string normalizer = GetParam();
  const ColorTable boxes = compiled(normalizer, "yuv_boxes", kBoxesYaml);
  const ColorTable original_hues =
      compiled(normalizer, "hue_pivots", "{gray_threshold: 25, hue_of: original}");
  const ColorTable normalized_hues =
      compiled(normalizer, "hue_pivots", "{gray_threshold: 25, hue_of: normalized}");
  std::size_t wrong_boxes = 0;
  std::size_t wrong_original_hues = 0;
  std::size_t wrong_normalized_hues = 0;
  for (std::size_t i = 0; i < ColorTable::kColors; i += kStep) {
    const Color color = color_at(i);
    const Color light_free = normalized(normalizer, color);
    wrong_boxes += label_in(boxes, color) != first_box(color, light_free);
    wrong_original_hues += label_in(original_hues, color) != nearest_hue(light_free, color);
    wrong_normalized_hues += label_in(normalized_hues, color) != nearest_hue(light_free, light_free);
  }
  EXPECT_EQ(wrong_boxes, 0U);
  EXPECT_EQ(wrong_original_hues, 0U);
  EXPECT_EQ(wrong_normalized_hues, 0U);
}

/// Stages as they are, but for what they say of boxes: nothing.
class SilentNormalizer final : public ColorNormalizer {
 public:
  explicit SilentNormalizer(const ColorNormalizer& stage) : stage_(stage) {}
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    stage_.normalize(in, out);
  }

 private:
  const ColorNormalizer& stage_;
};

class SilentSegmenter final : public ColorSegmenter {
 public:
  explicit SilentSegmenter(const ColorSegmenter& stage) : stage_(stage) {}
  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    stage_.segment(original, normalized, labels);
  }

 private:
  const ColorSegmenter& stage_;
};

TEST_P(CompiledPair, IsWhatComesOutWhenEveryColorIsAskedFor) {
  const auto normalizer_stage = testing::make<Normalizer>(GetParam());
  const auto& normalizer = dynamic_cast<const ColorNormalizer&>(*normalizer_stage);
  const std::size_t palette_size = testing::standard_palette().size();
  const auto expect_same = [&](const char* name, const std::string& yaml) {
    const auto stage = testing::make<Segmenter>(name, yaml);
    const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*stage);
    EXPECT_TRUE(
        ColorTable::compile(normalizer, segmenter, palette_size) ==
        ColorTable::compile(SilentNormalizer(normalizer), SilentSegmenter(segmenter), palette_size))
        << name << " " << yaml;
  };
  for (const std::string hue_of : {"original", "normalized"}) {
    for (const std::string rest :
         {"gray_threshold: 140",
          "gray_threshold: 7, pivots: {red: [250, 3, 20], blue: [4, 128], cyan: 127}",
          "gray_threshold: 3, exclude: [{hue: [250, 10], saturation: [0, 60]}, "
          "{hue: [200, 200]}, {hue: [90, 140], value: [33, 200], saturation: [100, 255]}]",
          "exclude: [{hue: [7, 6], saturation: [128, 128]}, {hue: [1, 0], value: [255, 255]}]"}) {
      expect_same("hue_pivots", "{hue_of: " + hue_of + ", " + rest + "}");
    }
  }
  expect_same("yuv_boxes", kBoxesYaml);
  expect_same("yuv_boxes",
              "{boxes: {red: {y: [0, 255], u: [0, 255], v: [150, 150]}, "
              "green: {y: [100, 101], u: [0, 255], v: [0, 255]}, "
              "blue: {y: [0, 255], u: [130, 255], v: [0, 255]}}}");
}

INSTANTIATE_TEST_SUITE_P(Normalizers, CompiledPair,
                         ::testing::Values("none", "chromatic", "vector", "weighted"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace maggic
