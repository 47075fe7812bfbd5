#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "maggic/testing.hpp"

namespace maggic {
namespace {

class ChromaticTest : public ::testing::Test {
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
  StagePtr<Normalizer> stage_ = testing::make<Normalizer>("chromatic");
};

TEST_F(ChromaticTest, SharesTheSumOutAsInThePaper) {
  EXPECT_EQ(normalized({200, 200, 30}), (Color{118, 118, 17}));
  EXPECT_EQ(normalized({255, 0, 0}), (Color{255, 0, 0}));
}

TEST_F(ChromaticTest, LeavesBlackBlack) { EXPECT_EQ(normalized({0, 0, 0}), (Color{0, 0, 0})); }

/// Whether q = floor(255 c / (R+G+B)), in integers.
bool is_exact(unsigned q, unsigned c, const std::array<std::uint8_t, 3>& rgb) {
  const unsigned sum = 0U + rgb[0] + rgb[1] + rgb[2];
  return sum == 0 ? q == 0 : q == 255 * c / sum;
}

TEST_F(ChromaticTest, TruncatesExactlyForEveryColor) {
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
