#include "maggic/longest_runs.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "blob/run_kernels.hpp"
#include "maggic/simd_target.hpp"

namespace maggic {
namespace {

using Runs = std::vector<maggic::Run>;
using ::testing::ElementsAre;

/// A run a row of these lengths, far enough to the right that a length is no column.
Runs runs_of_lengths(const std::vector<int>& lengths_px) {
  Runs runs;
  for (const int length_px : lengths_px) {
    const auto begin = static_cast<std::uint16_t>(length_px > 60000 ? 0 : 301);
    runs.push_back({static_cast<std::uint16_t>(runs.size()), begin,
                    static_cast<std::uint16_t>(begin + length_px),
                    static_cast<Label>(1 + runs.size() % 255)});
  }
  return runs;
}

Runs reaching(const Runs& runs, int shortest_px) {
  Runs kept;
  std::ranges::copy_if(runs, std::back_inserter(kept),
                       [&](const maggic::Run& run) { return run.end - run.begin >= shortest_px; });
  return kept;
}

int smallest_length_few_reach(const Runs& runs, std::size_t most) {
  int length_px = 1;
  while (reaching(runs, length_px).size() > most) ++length_px;
  return length_px;
}

/// Mostly the short runs of noise, a few of any length.
rc::Gen<std::vector<int>> noisy_lengths() {
  const auto length_px = rc::gen::weightedOneOf<int>({{20, rc::gen::inRange(1, 4)},
                                                      {3, rc::gen::inRange(1, 40)},
                                                      {1, rc::gen::inRange(1, 65536)}});
  return rc::gen::scale(8.0, rc::gen::container<std::vector<int>>(length_px));
}

RC_GTEST_PROP(LongestRuns, KeepsAllOfTheSmallestLengthThatFewEnoughReach, ()) {
  const Runs runs = runs_of_lengths(*noisy_lengths());
  const auto most = *rc::gen::inRange<std::size_t>(1, 2 + runs.size());
  LongestRuns longest;
  const std::span<const maggic::Run> kept = longest.keep(runs, most);
  RC_ASSERT(longest.shortest_px() == smallest_length_few_reach(runs, most));
  RC_ASSERT(std::ranges::equal(kept, reaching(runs, longest.shortest_px())));
}

TEST(LongestRuns, LeavesFramesWithFewEnoughRunsUntouched) {
  const Runs runs = runs_of_lengths({3, 1, 2});
  LongestRuns longest;
  EXPECT_EQ(longest.keep(runs, 3).data(), runs.data());
  EXPECT_EQ(longest.shortest_px(), 1);
}

TEST(LongestRuns, ForgetsTheFrameBefore) {
  LongestRuns longest;
  const Runs noise = runs_of_lengths(std::vector<int>(1000, 5));
  EXPECT_TRUE(longest.keep(noise, 10).empty());
  EXPECT_EQ(longest.shortest_px(), 6);
  const Runs runs = runs_of_lengths({2, 1, 2});
  EXPECT_THAT(longest.keep(runs, 2), ElementsAre(runs[0], runs[2]));
  EXPECT_EQ(longest.shortest_px(), 2);
}

TEST(LongestRuns, FindsTheFewLongOnesWhereverTheyLieAmongTheNoise) {
  constexpr std::size_t kRuns = 50'000;
  for (const std::size_t place : {0u, 17u, 24'999u, 49'997u}) {
    std::vector<int> lengths_px(kRuns);
    for (std::size_t i = 0; i < kRuns; ++i) lengths_px[i] = 1 + static_cast<int>(i % 3);
    lengths_px[place] = lengths_px[place + 2] = 12;
    const Runs runs = runs_of_lengths(lengths_px);
    LongestRuns longest;
    EXPECT_THAT(longest.keep(runs, 100), ElementsAre(runs[place], runs[place + 2]));
    EXPECT_EQ(longest.shortest_px(), 4);
  }
}

TEST(LongestRuns, KeepsNoneWhereTooManyShareTheGreatestLength) {
  const Runs runs = runs_of_lengths(std::vector<int>(70, 65535));
  LongestRuns longest;
  EXPECT_TRUE(longest.keep(runs, 69).empty());
  EXPECT_EQ(longest.shortest_px(), 65536);
}

/// Every vector instruction set of this machine in turn.
class RunKernels : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_simd_target(GetParam()); }
  void TearDown() override { use_simd_target({}); }
};

TEST_P(RunKernels, CountAndCopyWhatReachesALength) {
  constexpr int kLengths_px[] = {1, 2, 3, 300, 32767, 32768, 65535};
  for (std::size_t size = 0; size < 40; ++size) {
    std::vector<int> lengths_px(size);
    for (std::size_t i = 0; i < size; ++i) lengths_px[i] = kLengths_px[(i * i + size) % 7];
    const Runs runs = runs_of_lengths(lengths_px);
    for (const int shortest_px : {1, 2, 3, 4, 301, 32768, 32769, 65535, 65536}) {
      const Runs expected = reaching(runs, shortest_px);
      EXPECT_EQ(count_reaching(runs, shortest_px), expected.size());
      Runs kept(size + kCopyOverhang);
      kept.resize(copy_reaching(runs, shortest_px, kept.data()));
      EXPECT_EQ(kept, expected);
      Runs in_place = runs;
      in_place.resize(copy_reaching(in_place, shortest_px, in_place.data()));
      EXPECT_EQ(in_place, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, RunKernels, ::testing::ValuesIn(simd_targets()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace maggic
