#include "maggic/scan_area.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

constexpr int kRows = 6;
constexpr int kColumns = 12;

/// Every pixel of a picture of kRows × kColumns for which `is_in`.
template <class Predicate>
ScanArea area_where(const Predicate& is_in) {
  ScanArea area;
  for (std::uint16_t row = 0; row < kRows; ++row) {
    for (std::uint16_t column = 0; column < kColumns; ++column) {
      if (!is_in(row, column)) continue;
      if (column > 0 && is_in(row, column - 1)) {
        ++area.back().end;
      } else {
        area.push_back({row, column, static_cast<std::uint16_t>(column + 1)});
      }
    }
  }
  return area;
}

bool has(const std::vector<bool>& pixels, int row, int column) {
  return pixels[static_cast<std::size_t>(row * kColumns + column)];
}

std::vector<bool> random_pixels() {
  // One in four is missing, so that boxes are covered about as often as not.
  const auto picks =
      *rc::gen::container<std::vector<int>>(std::size_t{kRows * kColumns}, rc::gen::inRange(0, 4));
  std::vector<bool> pixels;
  for (const int pick : picks) pixels.push_back(pick > 0);
  return pixels;
}

TEST(ScanArea, ThatIsEmptyHoldsAndCoversNothing) {
  EXPECT_FALSE(holds({}, {0, 0}));
  EXPECT_FALSE(covers({}, whole_picture({3, 3}), {1, 1, 1, 1}));
  EXPECT_TRUE(covers({}, {}, {1, 1, 1, 1}));
}

TEST(ScanArea, CoversABoxUpToThePicturesEdge) {
  const ScanArea whole = whole_picture({8, 4});
  EXPECT_TRUE(covers(whole, whole, {-3, -3, 20, 20}));
  EXPECT_TRUE(covers({{0, 0, 3}, {1, 0, 3}}, whole, {-1, -1, 4, 3}));
  EXPECT_FALSE(covers({{0, 0, 3}, {1, 0, 2}}, whole, {-1, -1, 4, 3}));
}

RC_GTEST_PROP(ScanAreaProperty, HoldsWhatItIsMadeOf, ()) {
  const std::vector<bool> pixels = random_pixels();
  const ScanArea area = area_where([&](int row, int column) { return has(pixels, row, column); });
  for (int row = -1; row <= kRows; ++row) {
    for (int column = -1; column <= kColumns; ++column) {
      const bool is_in =
          cv::Rect(0, 0, kColumns, kRows).contains({column, row}) && has(pixels, row, column);
      RC_ASSERT(holds(area, {column, row}) == is_in);
    }
  }
}

RC_GTEST_PROP(ScanAreaProperty, CoversABoxWhenNoPixelOfItIsMissing, ()) {
  const std::vector<bool> whole_pixels = random_pixels();
  const std::vector<bool> kept = random_pixels();
  const auto in_whole = [&](int row, int column) { return has(whole_pixels, row, column); };
  const auto in_part = [&](int row, int column) {
    return in_whole(row, column) && has(kept, row, column);
  };
  const cv::Rect box_px(*rc::gen::inRange(-2, kColumns), *rc::gen::inRange(-2, kRows),
                        *rc::gen::inRange(1, 6), *rc::gen::inRange(1, 4));
  bool is_covered = true;
  for (int row = std::max(box_px.y, 0); row < std::min(box_px.br().y, kRows); ++row) {
    for (int column = std::max(box_px.x, 0); column < std::min(box_px.br().x, kColumns); ++column) {
      is_covered = is_covered && (!in_whole(row, column) || in_part(row, column));
    }
  }
  RC_ASSERT(covers(area_where(in_part), area_where(in_whole), box_px) == is_covered);
}

}  // namespace
}  // namespace maggic
