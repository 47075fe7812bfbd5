#include "maggic/color_table.hpp"

#include <algorithm>
#include <atomic>
#include <optional>
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

/// Label 2 where red is at least 101 and blue at most 40, and says so of boxes.
class Quarter final : public ColorSegmenter {
 public:
  explicit Quarter(Label label = 2) : label_(label) {}

  void segment(const ColorBatch& original, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    colors_asked_ += labels.size();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = original.r[i] >= 101 && original.b[i] <= 40 ? label_ : kBackground;
    }
  }

  std::optional<Label> label_of(const ColorBox& original,
                                const ColorBox& /*normalized*/) const override {
    if (original.r.first >= 101 && original.b.last <= 40) return label_;
    if (original.r.last < 101 || original.b.first > 40) return kBackground;
    return {};
  }

  std::size_t colors_asked() const { return colors_asked_; }

 private:
  Label label_;
  mutable std::atomic<std::size_t> colors_asked_{0};
};

/// The same, and says nothing of boxes.
class SilentQuarter final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    Quarter().segment(original, normalized, labels);
  }
};

/// Says of all colours what is not so.
class AllForeign final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& /*original*/, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    std::ranges::fill(labels, Label{5});
  }
  std::optional<Label> label_of(const ColorBox& /*original*/,
                                const ColorBox& /*normalized*/) const override {
    return Label{5};
  }
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

/// Both levels, not only what they say.
void expect_identical(const ColorTable& a, const ColorTable& b) {
  EXPECT_TRUE(std::ranges::equal(a.block_ids(), b.block_ids()));
  EXPECT_TRUE(std::ranges::equal(a.block_labels(), b.block_labels()));
}

TEST(ColorTable, DoesNotDependOnTheNumberOfThreads) {
  expect_identical(ColorTable::compile(Rotate(), Mix(), 16, 1),
                   ColorTable::compile(Rotate(), Mix(), 16, 3));
  expect_identical(ColorTable::compile(Rotate(), Quarter(), 3, 1),
                   ColorTable::compile(Rotate(), Quarter(), 3, 3));
}

TEST(ColorTable, IsTheSameWhetherTheStagesSpeakOfBoxesOrNot) {
  expect_identical(ColorTable::compile(Rotate(), Quarter(), 3),
                   ColorTable::compile(Rotate(), SilentQuarter(), 3));
}

TEST(ColorTable, AsksOnlyForColorsThatTheBoundsLeaveOpen) {
  const Quarter quarter;
  ColorTable::compile(Rotate(), quarter, 3);
  // The border runs along one layer of blocks in red and one in blue.
  const std::size_t red_layer = 32 * 6;
  const std::size_t blue_layer = 32 * 20;
  EXPECT_EQ(quarter.colors_asked(), (red_layer + blue_layer - 32) * ColorTable::kColorsPerBlock);
}

TEST(ColorTable, SharesOneBlockAmongAllOfOneLabel) {
  const ColorTable table = ColorTable::compile(Rotate(), Quarter(), 3);
  EXPECT_TRUE(table.is_uniform(ColorTable::block_index(0, 0, 255)));
  EXPECT_FALSE(table.is_uniform(ColorTable::block_index(40, 0, 255)));
  // 32 along green, times 5 of blue at red 101, times 20 of red at blue 40, that in both once.
  const std::size_t mixed = 32 * (6 + 20 - 1);
  EXPECT_EQ(table.block_labels().size(), (3 + mixed) * ColorTable::kColorsPerBlock);
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

TEST(ColorTable, RefusesALabelOfABoxThatThePaletteDoesNotHold) {
  try {
    ColorTable::compile(Rotate(), AllForeign(), 5, 1);
    FAIL() << "expected a std::logic_error";
  } catch (const std::logic_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("B 0 G 0 R 0 the label 5"));
  }
}

TEST(ColorTable, PassesOnWhatAStageThrowsOnAnyThread) {
  EXPECT_THROW(ColorTable::compile(Rotate(), Throwing(), 5, 2), std::runtime_error);
}

}  // namespace
}  // namespace maggic
