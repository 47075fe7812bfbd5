#include "../normalizer_for_tests.hpp"

namespace maggic {
namespace {

TEST(None, LeavesEveryColorAsItIs) {
  const auto is_same = [](unsigned q, unsigned c, const Rgb&) { return q == c; };
  EXPECT_EQ(NormalizerForTests("none").count_wrong(is_same), 0U);
}

}  // namespace
}  // namespace maggic
