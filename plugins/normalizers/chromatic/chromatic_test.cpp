#include "../normalizer_for_tests.hpp"

namespace maggic {
namespace {

TEST(Chromatic, SharesTheSumOutAsInThePaper) {
  const NormalizerForTests chromatic("chromatic");
  EXPECT_EQ(chromatic({200, 200, 30}), (Rgb{118, 118, 17}));
  EXPECT_EQ(chromatic({255, 0, 0}), (Rgb{255, 0, 0}));
}

TEST(Chromatic, LeavesBlackBlack) {
  EXPECT_EQ(NormalizerForTests("chromatic")({0, 0, 0}), (Rgb{0, 0, 0}));
}

TEST(Chromatic, TruncatesExactlyForEveryColor) {
  const auto is_exact = [](unsigned q, unsigned c, const Rgb& rgb) {
    const unsigned sum = 0U + rgb[0] + rgb[1] + rgb[2];
    return sum == 0 ? q == 0 : q == 255 * c / sum;
  };
  EXPECT_EQ(NormalizerForTests("chromatic").count_wrong(is_exact), 0U);
}

}  // namespace
}  // namespace maggic
