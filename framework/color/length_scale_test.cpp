#include "maggic/length_scale.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace maggic {
namespace {

/// Counts the (channel, length) pairs for which the factor gives another integer than the root,
/// over every colour: sorted channels suffice, since the length does not depend on their order.
std::size_t wrong_quotients(const std::array<std::uint32_t, 256>& numerators) {
  const LengthScale scale(numerators);
  std::size_t wrong = 0;
  const auto is_floor = [](std::uint64_t q, std::uint64_t numerator, std::uint64_t squared) {
    return q * q * squared <= numerator * numerator &&
           (q + 1) * (q + 1) * squared > numerator * numerator;
  };
  std::array<std::uint8_t, 256> b;
  std::array<std::uint8_t, 256> g;
  std::array<std::uint8_t, 256> r;
  std::array<float, 256> factors;
  for (unsigned i = 0; i < 256; ++i) b[i] = static_cast<std::uint8_t>(i);
  for (unsigned red = 0; red < 256; ++red) {
    for (unsigned green = 0; green <= red; ++green) {
      r.fill(static_cast<std::uint8_t>(red));
      g.fill(static_cast<std::uint8_t>(green));
      scale.look_up({b, g, r}, factors);
      for (unsigned blue = 0; blue < 256; ++blue) {
        const unsigned squared = red * red + green * green + blue * blue;
        if (squared == 0) {
          wrong += factors[blue] != 0.0F;
          continue;
        }
        for (const unsigned c : {blue, green, red}) {
          const float quotient = static_cast<float>(numerators[c]) * factors[blue];
          const auto q = static_cast<std::uint64_t>(quotient);
          wrong += !is_floor(q, numerators[c], squared);
        }
      }
    }
  }
  return wrong;
}

TEST(LengthScale, TruncatesEveryStretchedChannelExactly) {
  std::array<std::uint32_t, 256> stretched;
  for (std::uint32_t c = 0; c < 256; ++c) stretched[c] = 255 * c;
  EXPECT_EQ(wrong_quotients(stretched), 0U);
}

TEST(LengthScale, TruncatesEverySquaredChannelExactly) {
  std::array<std::uint32_t, 256> squares;
  for (std::uint32_t c = 0; c < 256; ++c) squares[c] = c * c;
  EXPECT_EQ(wrong_quotients(squares), 0U);
}

}  // namespace
}  // namespace maggic
