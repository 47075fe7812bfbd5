#include "calibration/hue_clusters.hpp"

#include <initializer_list>
#include <utility>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::calibration {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

HueHistogram histogram_of(std::initializer_list<std::pair<std::size_t, double>> weights) {
  HueHistogram histogram{};
  for (const auto& [hue, weight] : weights) histogram[hue] = weight;
  return histogram;
}

TEST(HueClusters, AnEmptyHistogramHasNoPeak) { EXPECT_THAT(cluster_hues({}, {}).peaks, IsEmpty()); }

TEST(HueClusters, ALonePeakOwnsEveryHue) {
  const HueClusters clusters = cluster_hues(histogram_of({{100, 7.0}}), {});
  EXPECT_THAT(clusters.peaks, ElementsAre(100));
  EXPECT_THAT(clusters.of_hue, Each(0));
}

TEST(HueClusters, WhereEveryHueIsAlikeThereIsOneColour) {
  HueHistogram histogram;
  histogram.fill(3.0);
  EXPECT_EQ(cluster_hues(histogram, {}).peaks.size(), 1u);
}

TEST(HueClusters, TheBorderIsInTheMiddleOfTheEmptyValley) {
  // Smoothing by 2 steps reaches 6: hues 57 … 93 are empty, and 107 … 299 on the other way round.
  const HueClusters clusters = cluster_hues(histogram_of({{50, 4.0}, {100, 4.0}}), {});
  EXPECT_THAT(clusters.peaks, ElementsAre(50, 100));
  EXPECT_EQ(clusters.of_hue[75], 0);
  EXPECT_EQ(clusters.of_hue[76], 1);
  EXPECT_EQ(clusters.of_hue[203], 1);
  EXPECT_EQ(clusters.of_hue[204], 0);
}

TEST(HueClusters, APeakAroundZeroIsOnePeak) {
  const HueClusters clusters = cluster_hues(
      histogram_of({{254, 2.0}, {255, 3.0}, {0, 4.0}, {1, 3.0}, {2, 2.0}, {128, 9.0}}), {});
  EXPECT_THAT(clusters.peaks, ElementsAre(0, 128));
  EXPECT_EQ(clusters.of_hue[250], clusters.of_hue[5]);
  EXPECT_NE(clusters.of_hue[250], clusters.of_hue[128]);
}

TEST(HueClusters, PeaksNearerThanTheRuleAreOneColourTheHigherOnes) {
  const HueHistogram histogram = histogram_of({{100, 8.0}, {105, 10.0}, {200, 9.0}});
  PeakRules rules{.sigma = 0.5, .min_distance = 6};
  EXPECT_THAT(cluster_hues(histogram, rules).peaks, ElementsAre(105, 200));
  rules.min_distance = 5;
  EXPECT_THAT(cluster_hues(histogram, rules).peaks, ElementsAre(100, 105, 200));
}

TEST(HueClusters, AShallowValleyPartsNothing) {
  HueHistogram histogram{};
  for (std::size_t hue = 90; hue <= 120; ++hue) histogram[hue] = 7.0;
  histogram[95] = histogram[115] = 10.0;
  EXPECT_EQ(cluster_hues(histogram, {.sigma = 0.5}).peaks.size(), 1u);
  for (std::size_t hue = 100; hue <= 110; ++hue) histogram[hue] = 2.0;
  EXPECT_THAT(cluster_hues(histogram, {.sigma = 0.5}).peaks, ElementsAre(95, 115));
}

TEST(HueClusters, APeakOfLittleHeightIsNone) {
  const HueHistogram histogram = histogram_of({{40, 100.0}, {140, 7.0}});
  EXPECT_THAT(cluster_hues(histogram, {.min_height = 0.08}).peaks, ElementsAre(40));
  EXPECT_THAT(cluster_hues(histogram, {.min_height = 0.06}).peaks, ElementsAre(40, 140));
}

RC_GTEST_PROP(HueClustersProperty, TurningTheHistogramTurnsTheAnswer, ()) {
  HueHistogram histogram{};
  const int bumps = *rc::gen::inRange(1, 9);
  for (int i = 0; i < bumps; ++i) {
    const auto hue = *rc::gen::inRange<std::size_t>(0, kHues);
    // Odd fractions, so that no two peaks are equally high and nothing hangs on their order.
    histogram[hue] += *rc::gen::inRange(1'000, 1'000'000) + 0.01 * i;
  }
  const auto turn = *rc::gen::inRange<std::size_t>(0, kHues);
  HueHistogram turned{};
  for (std::size_t hue = 0; hue < kHues; ++hue) turned[(hue + turn) % kHues] = histogram[hue];
  const HueClusters before = cluster_hues(histogram, {});
  const HueClusters after = cluster_hues(turned, {});
  RC_ASSERT(before.peaks.size() == after.peaks.size());
  for (std::size_t hue = 0; hue < kHues; ++hue) {
    const int peak = before.peaks[before.of_hue[hue]];
    const int peak_after = after.peaks[after.of_hue[(hue + turn) % kHues]];
    RC_ASSERT((peak + static_cast<int>(turn)) % kHues == peak_after);
  }
}

RC_GTEST_PROP(HueClustersProperty, EveryPeakLiesOnItsOwnSlope, ()) {
  HueHistogram histogram{};
  for (double& weight : histogram) weight = *rc::gen::inRange(0, 50);
  const HueClusters clusters = cluster_hues(histogram, {});
  for (std::size_t i = 0; i < clusters.peaks.size(); ++i) {
    RC_ASSERT(clusters.of_hue[static_cast<std::size_t>(clusters.peaks[i])] == i);
    // Not in one assertion: RapidCheck's operators do not stop at the first true operand.
    if (i > 0) RC_ASSERT(clusters.peaks[i - 1] < clusters.peaks[i]);
  }
}

}  // namespace
}  // namespace maggic::calibration
