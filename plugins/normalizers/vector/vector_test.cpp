#include "../normalizer_for_tests.hpp"

namespace maggic {
namespace {

TEST(Vector, StretchesToLength255AsInThePaper) {
  const NormalizerForTests vector("vector");
  EXPECT_EQ(vector({200, 200, 30}), (Rgb{179, 179, 26}));
  EXPECT_EQ(vector({1, 0, 0}), (Rgb{255, 0, 0}));
}

TEST(Vector, LeavesBlackBlack) {
  EXPECT_EQ(NormalizerForTests("vector")({0, 0, 0}), (Rgb{0, 0, 0}));
}

TEST(Vector, TruncatesExactlyForEveryColor) {
  const auto is_exact = [](std::uint64_t q, std::uint64_t c, const Rgb& rgb) {
    return is_floor_over_length(q, 255 * c, rgb);
  };
  EXPECT_EQ(NormalizerForTests("vector").count_wrong(is_exact), 0U);
}

}  // namespace
}  // namespace maggic
