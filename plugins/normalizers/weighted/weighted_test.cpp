#include "../normalizer_for_tests.hpp"

namespace maggic {
namespace {

TEST(Weighted, WeighsEachChannelAsInThePaper) {
  const NormalizerForTests weighted("weighted");
  EXPECT_EQ(weighted({100, 99, 99}), (Rgb{58, 56, 56}));
  EXPECT_EQ(weighted({200, 200, 30}), (Rgb{140, 140, 3}));
  EXPECT_EQ(weighted({255, 0, 0}), (Rgb{255, 0, 0}));
}

TEST(Weighted, LeavesBlackBlack) {
  EXPECT_EQ(NormalizerForTests("weighted")({0, 0, 0}), (Rgb{0, 0, 0}));
}

TEST(Weighted, TruncatesExactlyForEveryColor) {
  const auto is_exact = [](std::uint64_t q, std::uint64_t c, const Rgb& rgb) {
    return is_floor_over_length(q, c * c, rgb);
  };
  EXPECT_EQ(NormalizerForTests("weighted").count_wrong(is_exact), 0U);
}

}  // namespace
}  // namespace maggic
