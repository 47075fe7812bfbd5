#include "calibration/pattern_candidates.hpp"

#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "calibration/tags_for_tests.hpp"

namespace maggic::calibration {
namespace {

using tags::Pose;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::array<double, 3> kAnyHues{10.0, 20.0, 30.0};

std::vector<TagLayout> two_tag() { return {two_tag_layout(Palette::standard())}; }
std::vector<TagLayout> three_tag() { return {three_tag_layout(Palette::standard())}; }

std::vector<Patch> patches_of(const TagLayout& layout, const Pose& pose) {
  std::vector<Patch> patches;
  tags::add_robot(layout, pose, kAnyHues, patches);
  return patches;
}

TEST(PatternCandidates, TwoHalvesAreReadBothWays) {
  const auto layouts = two_tag();
  const auto patches = patches_of(layouts[0], {{100, 100}, 30.0});
  const auto found = list_candidates(patches, layouts, std::nullopt);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_THAT(found[0].patches, ElementsAre(0, 1));
  EXPECT_THAT(found[1].patches, ElementsAre(1, 0));
  for (const PatternCandidate& candidate : found) {
    EXPECT_NEAR(candidate.mm_per_px, 2.5, 1e-6);
    EXPECT_NEAR(candidate.misfit, 0.0, 1e-6);
  }
}

TEST(PatternCandidates, ThreePatchesAreReadOneWayAndNeverMirrored) {
  const auto layouts = three_tag();
  const auto patches = patches_of(layouts[0], {{100, 100}, 200.0});
  const auto found = list_candidates(patches, layouts, std::nullopt);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].patches, ElementsAre(0, 1, 2)) << "left and right are not to be exchanged";
}

TEST(PatternCandidates, AKnownSizeLeavesOutEveryOther) {
  const auto layouts = two_tag();
  const TagMetric metric = TagMetric::of_scale(2.5);
  EXPECT_THAT(list_candidates(patches_of(layouts[0], {{100, 100}, 30.0}), layouts, metric),
              SizeIs(2));
  for (const double px_per_mm : {0.2, 0.7}) {
    const auto patches = patches_of(layouts[0], {{100, 100}, 30.0, {px_per_mm, px_per_mm}});
    EXPECT_THAT(list_candidates(patches, layouts, metric), IsEmpty()) << px_per_mm;
    EXPECT_THAT(list_candidates(patches, layouts, std::nullopt), SizeIs(2)) << px_per_mm;
  }
}

TEST(PatternCandidates, AKnownSizeLeavesOutPatchesTooFarApartForIt) {
  const auto layouts = two_tag();
  const std::vector<Patch> patches{tags::patch_at({0, 0}, 590, 0), tags::patch_at({23, 0}, 590, 0)};
  EXPECT_THAT(list_candidates(patches, layouts, std::nullopt), SizeIs(2));
  EXPECT_THAT(list_candidates(patches, layouts, TagMetric::of_scale(2.5)), IsEmpty());
}

TEST(PatternCandidates, APatchMayLieALittleOffItsPlaceButNotFar) {
  const auto layouts = three_tag();
  auto patches = patches_of(layouts[0], {{100, 100}, 0.0});
  const double mm = 0.4;
  patches[2].centroid_px += cv::Point2d(6.0 * mm, 4.0 * mm);
  EXPECT_THAT(list_candidates(patches, layouts, std::nullopt), SizeIs(1));
  patches[2].centroid_px += cv::Point2d(0.0, 35.0 * mm);
  EXPECT_THAT(list_candidates(patches, layouts, std::nullopt), IsEmpty());
}

TEST(PatternCandidates, InAStretchedPictureTheMetricTakesTheStretchOut) {
  const auto layouts = three_tag();
  const TagMetric metric{{4.0, 0.0, 0.0, 9.0}};
  const auto patches = patches_of(layouts[0], {{100, 100}, 40.0, {1.0 / 2.0, 1.0 / 3.0}});
  const auto found = list_candidates(patches, layouts, metric);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].misfit, 0.0, 1e-6);
}

TEST(PatternCandidates, PatchesFarApartOrOfUnequalSizeAreNoRobot) {
  const auto layouts = two_tag();
  const std::vector<Patch> apart{tags::patch_at({0, 0}, 400, 0), tags::patch_at({70, 0}, 400, 0)};
  EXPECT_THAT(list_candidates(apart, layouts, std::nullopt), IsEmpty());
  const std::vector<Patch> unequal{tags::patch_at({0, 0}, 400, 0), tags::patch_at({14, 0}, 100, 0)};
  EXPECT_THAT(list_candidates(unequal, layouts, std::nullopt), IsEmpty());
}

TEST(PatternCandidates, NothingToReadGivesNothing) {
  EXPECT_THAT(list_candidates({}, two_tag(), std::nullopt), IsEmpty());
  const std::vector<Patch> lone{tags::patch_at({5, 5}, 300, 0)};
  EXPECT_THAT(list_candidates(lone, two_tag(), std::nullopt), IsEmpty());
}

TEST(PatternCandidates, TwoPatchesOnOneSpotAreNoRobot) {
  const std::vector<Patch> same(2, tags::patch_at({5, 5}, 300, 0));
  EXPECT_THAT(list_candidates(same, two_tag(), std::nullopt), IsEmpty());
}

RC_GTEST_PROP(PatternCandidatesProperty, ARobotOfAnySizePlaceAndHeadingIsFound, ()) {
  const auto layouts = *rc::gen::arbitrary<bool>() ? two_tag() : three_tag();
  const double px_per_mm = *rc::gen::inRange(50, 5000) / 1000.0;
  const Pose pose{{*rc::gen::inRange(-500, 1500) + 0.0, *rc::gen::inRange(-500, 1500) + 0.0},
                  *rc::gen::inRange(0, 360) + 0.0,
                  {px_per_mm, px_per_mm}};
  const auto patches = patches_of(layouts[0], pose);
  const auto found = list_candidates(patches, layouts, std::nullopt);
  RC_ASSERT(!found.empty());
  RC_ASSERT(std::abs(found[0].mm_per_px * px_per_mm - 1.0) < 1e-6);
  RC_ASSERT(found[0].misfit < 1e-6);
  for (int i = 0; i < static_cast<int>(patches.size()); ++i) {
    RC_ASSERT(found[0].patches[static_cast<std::size_t>(i)] == i);
  }
}

TEST(ChooseApart, APatternOfMorePatchesGoesFirst) {
  const PatternCandidate pair{.layout = 0, .patches = {0, 1}, .misfit = 0.0};
  const PatternCandidate triple{.layout = 1, .patches = {0, 1, 2}, .misfit = 0.5};
  const std::array<PatternCandidate, 2> candidates{pair, triple};
  EXPECT_THAT(choose_apart(candidates, 3), ElementsAre(&candidates[1]));
}

TEST(ChooseApart, TheBetterFitTakesThePatchesItNeeds) {
  const std::array<PatternCandidate, 3> candidates{
      PatternCandidate{.layout = 0, .patches = {0, 1}, .misfit = 0.4},
      PatternCandidate{.layout = 0, .patches = {1, 2}, .misfit = 0.1},
      PatternCandidate{.layout = 0, .patches = {0, 3}, .misfit = 0.9}};
  EXPECT_THAT(choose_apart(candidates, 4), ElementsAre(&candidates[1], &candidates[2]));
}

}  // namespace
}  // namespace maggic::calibration
