#include "exclusion_fit.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::hue_pivots {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Range {
  int first;
  int last;
};

/// A pixel for every hue and every third value and saturation of the ranges.
std::vector<Hsv> pixels(Range hue, Range value, Range saturation = {200, 230}) {
  std::vector<Hsv> colors;
  for (int h = hue.first; h <= hue.last; ++h) {
    for (int v = value.first; v <= value.last; v += 3) {
      for (int s = saturation.first; s <= saturation.last; s += 3) {
        colors.push_back({static_cast<std::uint8_t>((h + 256) % 256), static_cast<std::uint8_t>(s),
                          static_cast<std::uint8_t>(v)});
      }
    }
  }
  return colors;
}

bool lies_in(const Span& span, int number) {
  if (span.first <= span.last) return number >= span.first && number <= span.last;
  return number >= span.first || number <= span.last;
}

bool excludes(const ExclusionFit& fit, const Hsv& color) {
  return std::ranges::any_of(fit.exclusions, [&](const FittedExclusion& e) {
    return lies_in(e.hue, color.hue) && lies_in(e.value, color.value) &&
           lies_in(e.saturation, color.saturation);
  });
}

double excluded_share(const ExclusionFit& fit, const std::vector<Hsv>& colors) {
  const auto count =
      std::ranges::count_if(colors, [&](const Hsv& color) { return excludes(fit, color); });
  return static_cast<double>(count) / static_cast<double>(colors.size());
}

TEST(ExclusionFit, LeavesNothingOutWhereNothingIsInTheWay) {
  const ExclusionFit fit = fit_exclusions(pixels({10, 20}, {150, 200}), {});
  EXPECT_THAT(fit.exclusions, IsEmpty());
  EXPECT_EQ(fit.left_over, 0.0);
}

TEST(ExclusionFit, LeavesOutAHueNoTagHas) {
  const auto tags = pixels({10, 20}, {150, 200});
  const auto others = pixels({60, 64}, {150, 200});
  const ExclusionFit fit = fit_exclusions(tags, others);
  ASSERT_THAT(fit.exclusions, SizeIs(1));
  EXPECT_EQ(fit.exclusions[0].hue.first, 57) << "with a margin of three hues";
  EXPECT_EQ(fit.exclusions[0].hue.last, 67);
  EXPECT_EQ(fit.exclusions[0].share, 1.0);
  EXPECT_EQ(fit.left_over, 0.0);
}

TEST(ExclusionFit, TheMarginEndsHalfWayToATag) {
  const ExclusionFit fit =
      fit_exclusions(pixels({10, 20}, {150, 200}), pixels({24, 30}, {150, 200}));
  ASSERT_THAT(fit.exclusions, SizeIs(1));
  EXPECT_GT(fit.exclusions[0].hue.first, 21);
  EXPECT_LE(fit.exclusions[0].hue.first, 24);
}

TEST(ExclusionFit, HuesAroundZeroAreOneSpan) {
  const auto others = pixels({-4, 4}, {150, 200});
  const ExclusionFit fit = fit_exclusions(pixels({100, 110}, {150, 200}), others);
  ASSERT_THAT(fit.exclusions, SizeIs(1));
  EXPECT_GT(fit.exclusions[0].hue.first, fit.exclusions[0].hue.last);
  EXPECT_EQ(excluded_share(fit, others), 1.0);
}

TEST(ExclusionFit, WhatIsDarkerThanEveryTagOfItsHueIsLeftOutByBrightness) {
  const auto tags = pixels({10, 20}, {150, 200});
  const auto others = pixels({12, 18}, {60, 90});
  const ExclusionFit fit = fit_exclusions(tags, others);
  ASSERT_THAT(fit.exclusions, SizeIs(1));
  EXPECT_EQ(fit.exclusions[0].value.first, 0);
  EXPECT_GE(fit.exclusions[0].value.last, 90);
  EXPECT_LT(fit.exclusions[0].value.last, 120) << "tags may be seen darker one day";
  EXPECT_EQ(excluded_share(fit, tags), 0.0);
  EXPECT_EQ(excluded_share(fit, others), 1.0);
}

TEST(ExclusionFit, WhatIsPalerThanEveryTagOfItsHueIsLeftOutBySaturation) {
  const auto tags = pixels({10, 20}, {150, 200}, {180, 240});
  const auto others = pixels({12, 18}, {150, 200}, {60, 90});
  const ExclusionFit fit = fit_exclusions(tags, others);
  ASSERT_THAT(fit.exclusions, SizeIs(1));
  EXPECT_EQ(fit.exclusions[0].value.last, 255) << "brightness tells nothing";
  EXPECT_EQ(excluded_share(fit, tags), 0.0);
  EXPECT_EQ(excluded_share(fit, others), 1.0);
}

TEST(ExclusionFit, WhatNothingTellsFromATagIsLeftOverAndSaid) {
  const auto tags = pixels({10, 20}, {150, 200});
  const ExclusionFit fit = fit_exclusions(tags, pixels({12, 18}, {160, 190}));
  EXPECT_THAT(fit.exclusions, IsEmpty());
  EXPECT_EQ(fit.left_over, 1.0);
}

TEST(ExclusionFit, AFewPixelsAreNoReason) {
  EXPECT_THAT(fit_exclusions(pixels({10, 20}, {150, 200}), pixels({60, 60}, {150, 150})).exclusions,
              IsEmpty());
}

TEST(HuesNear, AreThoseOfTagsAndTheirNeighboursRoundTheCircle) {
  const auto tags = pixels({253, 255}, {150, 200});
  const auto near = hues_near(tags, 4);
  EXPECT_TRUE(near[252]) << "a hue to either side counts as the tag's own";
  EXPECT_TRUE(near[0]);
  EXPECT_TRUE(near[248]);
  EXPECT_TRUE(near[4]);
  EXPECT_FALSE(near[247]);
  EXPECT_FALSE(near[5]);
  EXPECT_FALSE(hues_near(tags, 0)[251]);
}

TEST(HuesNear, AFewStrayPixelsMakeNoHueATags) {
  auto tags = pixels({100, 110}, {150, 200}, {140, 230});
  tags.resize(5'000, tags.back());
  tags.push_back({30, 200, 200});
  EXPECT_FALSE(hues_near(tags, 3)[30]);
  EXPECT_TRUE(hues_near(tags, 3)[105]);
}

TEST(HuesNear, WithoutTagsThereAreNone) { EXPECT_THAT(hues_near({}, 10), ::testing::Each(false)); }

RC_GTEST_PROP(ExclusionFitProperty, LosesHardlyAPixelOfATag, ()) {
  const auto any_pixels = [] {
    std::vector<Hsv> colors;
    for (int group = *rc::gen::inRange(1, 5); group > 0; --group) {
      const int hue = *rc::gen::inRange(0, 256);
      const int value = *rc::gen::inRange(40, 200);
      const int saturation = *rc::gen::inRange(40, 200);
      const auto more = pixels({hue, hue + *rc::gen::inRange(1, 12)}, {value, value + 30},
                               {saturation, saturation + 30});
      colors.insert(colors.end(), more.begin(), more.end());
    }
    return colors;
  };
  const auto tags = any_pixels();
  const auto others = any_pixels();
  const ExclusionFit fit = fit_exclusions(tags, others);
  RC_ASSERT(fit.exclusions.size() <= 12u);
  RC_ASSERT(excluded_share(fit, tags) <= 0.03);
  RC_ASSERT(std::abs(1.0 - excluded_share(fit, others) - fit.left_over) < 1e-9);
}

}  // namespace
}  // namespace maggic::hue_pivots
