#include "maggic/color_box.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

/// Boxes of at most 7 values a channel, near each other so that grays are common.
ColorBox any_box() {
  const auto range = [] {
    const int first = *rc::gen::inRange(0, 20);
    return ChannelRange{static_cast<std::uint8_t>(first),
                        static_cast<std::uint8_t>(first + *rc::gen::inRange(0, 7))};
  };
  return {range(), range(), range()};
}

/// Calls `visit(value, spread)` for every colour of the box.
template <class F>
void for_every_color(const ColorBox& box, F visit) {
  for (int b = box.b.first; b <= box.b.last; ++b) {
    for (int g = box.g.first; g <= box.g.last; ++g) {
      for (int r = box.r.first; r <= box.r.last; ++r) {
        const auto [smallest, largest] = std::minmax({b, g, r});
        visit(largest, largest - smallest);
      }
    }
  }
}

void include(int number, ChannelRange& range) {
  range.first = static_cast<std::uint8_t>(std::min<int>(range.first, number));
  range.last = static_cast<std::uint8_t>(std::max<int>(range.last, number));
}

RC_GTEST_PROP(ColorBox, TellsTheExtremesOfItsColors, ()) {
  const ColorBox box = any_box();
  ChannelRange values{255, 0};
  ChannelRange spreads{255, 0};
  for_every_color(box, [&](int value, int spread) {
    include(value, values);
    include(spread, spreads);
  });
  RC_ASSERT(value_range(box) == values);
  RC_ASSERT(spread_range(box) == spreads);
  RC_ASSERT(holds_gray(box) == (spreads.first == 0));
}

TEST(ColorBox, IsTheWholeCubeAtFirst) {
  EXPECT_EQ(value_range({}), (ChannelRange{0, 255}));
  EXPECT_EQ(spread_range({}), (ChannelRange{0, 255}));
  EXPECT_TRUE(holds_gray({}));
}

}  // namespace
}  // namespace maggic
