#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "maggic/testing.hpp"

namespace maggic {
namespace {

class VectorTest : public ::testing::Test {
 protected:
  using Color = std::array<std::uint8_t, 3>;  ///< R, G, B.

  const ColorNormalizer& normalizer() const {
    return dynamic_cast<const ColorNormalizer&>(*stage_);
  }

  Color normalized(Color rgb) const {
    Color out;
    normalizer().normalize({{&rgb[2], 1}, {&rgb[1], 1}, {&rgb[0], 1}},
                           {{&out[2], 1}, {&out[1], 1}, {&out[0], 1}});
    return out;
  }

 private:
  StagePtr<Normalizer> stage_ = testing::make<Normalizer>("vector");
};

TEST_F(VectorTest, StretchesToLength255AsInThePaper) {
  EXPECT_EQ(normalized({200, 200, 30}), (Color{179, 179, 26}));
  EXPECT_EQ(normalized({1, 0, 0}), (Color{255, 0, 0}));
}

TEST_F(VectorTest, LeavesBlackBlack) { EXPECT_EQ(normalized({0, 0, 0}), (Color{0, 0, 0})); }

/// Whether q = floor(255 c / |v|), in integers: the largest q with q² |v|² <= (255 c)².
bool is_exact(std::uint64_t q, std::uint64_t c, const std::array<std::uint8_t, 3>& rgb) {
  std::uint64_t squared = 0;
  for (const std::uint64_t channel : rgb) squared += channel * channel;
  if (squared == 0) return q == 0;
  const std::uint64_t numerator = 255 * c;
  return q * q * squared <= numerator * numerator &&
         (q + 1) * (q + 1) * squared > numerator * numerator;
}

TEST_F(VectorTest, TruncatesExactlyForEveryColor) {
  constexpr std::size_t kBatch = 256 * 256;
  std::vector<std::uint8_t> b(kBatch);
  std::vector<std::uint8_t> g(kBatch);
  std::vector<std::uint8_t> r(kBatch);
  std::vector<std::uint8_t> out_b(kBatch);
  std::vector<std::uint8_t> out_g(kBatch);
  std::vector<std::uint8_t> out_r(kBatch);
  for (std::size_t i = 0; i < kBatch; ++i) {
    b[i] = static_cast<std::uint8_t>(i & 255);
    g[i] = static_cast<std::uint8_t>(i >> 8);
  }
  std::size_t wrong = 0;
  for (unsigned red = 0; red < 256; ++red) {
    r.assign(kBatch, static_cast<std::uint8_t>(red));
    normalizer().normalize({b, g, r}, {out_b, out_g, out_r});
    for (std::size_t i = 0; i < kBatch; ++i) {
      const Color rgb{r[i], g[i], b[i]};
      wrong += !is_exact(out_b[i], b[i], rgb) || !is_exact(out_g[i], g[i], rgb) ||
               !is_exact(out_r[i], r[i], rgb);
    }
  }
  EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace maggic
