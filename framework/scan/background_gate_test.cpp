#include "scan/background_gate.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::Each;

ColorTable compiled(const char* normalizer, const char* segmenter, const char* yaml) {
  const auto normalizer_stage = testing::make<Normalizer>(normalizer);
  const auto segmenter_stage = testing::make<Segmenter>(segmenter, yaml);
  return ColorTable::compile(dynamic_cast<const ColorNormalizer&>(*normalizer_stage),
                             dynamic_cast<const ColorSegmenter&>(*segmenter_stage),
                             testing::standard_palette().size());
}

TEST(BackgroundGate, LetsNothingThroughWhereNothingHasALabel) {
  EXPECT_THAT(BackgroundGate(ColorTable()).first_colored_spread(), Each(255));
}

TEST(BackgroundGate, FindsTheGrayThresholdInTheTable) {
  const BackgroundGate gate(compiled("none", "hue_pivots", "gray_threshold: 20"));
  EXPECT_EQ(gate.first_colored_spread()[0], 255);  // values up to 15: no spread above 20
  for (std::size_t i = 1; i < 16; ++i) EXPECT_EQ(gate.first_colored_spread()[i], 21);
  EXPECT_TRUE(gate.helps());
}

TEST(BackgroundGate, ServesBoxesToo) {
  // Pure blue of any brightness above 29, and nothing gray.
  const BackgroundGate gate(
      compiled("none", "yuv_boxes", "boxes: {blue: {y: [0, 255], u: [170, 255], v: [0, 255]}}"));
  EXPECT_TRUE(gate.helps());
  EXPECT_GT(gate.first_colored_spread()[15], 40);
}

TEST(BackgroundGate, SaysThatItCannotHelpWhereGrayHasALabel) {
  const BackgroundGate gate(
      compiled("none", "yuv_boxes", "boxes: {blue: {y: [0, 255], u: [120, 136], v: [0, 255]}}"));
  EXPECT_THAT(gate.first_colored_spread(), Each(0));
  EXPECT_FALSE(gate.helps());
}

TEST(BackgroundGate, IsTheTightestOneThatIsTrue) {
  for (const char* normalizer : {"weighted", "chromatic"}) {
    const ColorTable table = compiled(normalizer, "hue_pivots", "gray_threshold: 25");
    const BackgroundGate gate(table);
    std::array<std::uint8_t, 16> smallest;
    smallest.fill(255);
    for (int r = 0; r < 256; ++r) {
      for (int g = 0; g < 256; ++g) {
        for (int b = 0; b < 256; ++b) {
          if (table(static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g),
                    static_cast<std::uint8_t>(r)) == kBackground) {
            continue;
          }
          const int value = std::max({b, g, r});
          const int spread = value - std::min({b, g, r});
          std::uint8_t& first = smallest[static_cast<std::size_t>(value >> 4)];
          first = static_cast<std::uint8_t>(std::min<int>(first, spread));
        }
      }
    }
    EXPECT_EQ(gate.first_colored_spread(), smallest);
  }
}

}  // namespace
}  // namespace maggic
