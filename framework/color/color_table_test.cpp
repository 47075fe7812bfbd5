#include "maggic/color_table.hpp"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace maggic {
namespace {

/// Turns the channels round, so that a mistake in their order shows.
class Rotate final : public ColorNormalizer {
 public:
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    std::ranges::copy(in.g, out.b.begin());
    std::ranges::copy(in.r, out.g.begin());
    std::ranges::copy(in.b, out.r.begin());
  }
};

Label mixed_label(int b, int g, int r, int normalized_b) {
  return static_cast<Label>((b * 31 + g * 7 + r + normalized_b * 3) & 15);
}

class Mix final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = mixed_label(original.b[i], original.g[i], original.r[i], normalized.b[i]);
    }
  }
};

/// Gives one colour a label of its own.
class OneColor final : public ColorSegmenter {
 public:
  explicit OneColor(Label label) : label_(label) {}
  void segment(const ColorBatch& original, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool match = original.b[i] == 10 && original.g[i] == 200 && original.r[i] == 255;
      labels[i] = match ? label_ : kBackground;
    }
  }

 private:
  Label label_;
};

class Throwing final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& /*original*/, const ColorBatch& /*normalized*/,
               std::span<Label> /*labels*/) const override {
    throw std::runtime_error("no label today");
  }
};

TEST(ColorTable, IsBackgroundEverywhereAtFirst) {
  const ColorTable table;
  EXPECT_TRUE(table.is_uniform(0));
  EXPECT_EQ(table(1, 2, 3), kBackground);
}

TEST(ColorTable, HoldsTheChainsAnswerForEveryColor) {
  const ColorTable table = ColorTable::compile(Rotate(), Mix(), 16);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < ColorTable::kColors; ++i) {
    const int b = static_cast<int>(i & 255);
    const int g = static_cast<int>(i >> 8 & 255);
    const int r = static_cast<int>(i >> 16);
    const Label label = table(static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g),
                              static_cast<std::uint8_t>(r));
    wrong += label != mixed_label(b, g, r, g);
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(ColorTable, DoesNotDependOnTheNumberOfThreads) {
  const ColorTable one = ColorTable::compile(Rotate(), Mix(), 16, 1);
  EXPECT_EQ(ColorTable::compile(Rotate(), Mix(), 16, 3), one);
}

TEST(ColorTable, AcceptsThePalettesLastLabel) {
  const ColorTable table = ColorTable::compile(Rotate(), OneColor(4), 5);
  EXPECT_EQ(table(10, 200, 255), 4);
  EXPECT_EQ(table(10, 200, 254), kBackground);
}

TEST(ColorTable, RefusesALabelThePaletteDoesNotHold) {
  try {
    ColorTable::compile(Rotate(), OneColor(5), 5, 2);
    FAIL() << "expected a std::logic_error";
  } catch (const std::logic_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("B 10 G 200 R 255 the label 5"));
  }
}

TEST(ColorTable, PassesOnWhatAStageThrowsOnAnyThread) {
  EXPECT_THROW(ColorTable::compile(Rotate(), Throwing(), 5, 2), std::runtime_error);
}

}  // namespace
}  // namespace maggic
