#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "maggic/testing.hpp"

namespace maggic {
namespace {

TEST(None, LeavesEveryChannelAsItIs) {
  const auto none = testing::make<Normalizer>("none");
  const auto& normalizer = dynamic_cast<const ColorNormalizer&>(*none);
  const std::array<std::uint8_t, 3> b{0, 17, 255};
  const std::array<std::uint8_t, 3> g{1, 18, 254};
  const std::array<std::uint8_t, 3> r{2, 19, 253};
  std::array<std::uint8_t, 3> out_b;
  std::array<std::uint8_t, 3> out_g;
  std::array<std::uint8_t, 3> out_r;
  normalizer.normalize({b, g, r}, {out_b, out_g, out_r});
  EXPECT_EQ(out_b, b);
  EXPECT_EQ(out_g, g);
  EXPECT_EQ(out_r, r);
}

}  // namespace
}  // namespace maggic
