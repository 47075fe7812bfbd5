#include "calibration/patch_finder.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "calibration/tags_for_tests.hpp"

namespace maggic::calibration {
namespace {

using tags::color_of_hue;
using tags::look_at;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kRedHue = 250;
constexpr int kBlueHue = 160;

cv::Mat gray_floor() { return {240, 320, CV_8UC3, cv::Scalar(60, 60, 60)}; }

void fill(cv::Mat& picture, cv::Rect where, int hue) { picture(where).setTo(color_of_hue(hue)); }

std::vector<Patch> by_x(std::vector<Patch> patches) {
  std::ranges::sort(patches, {}, [](const Patch& p) { return p.centroid_px.x; });
  return patches;
}

TEST(PatchFinder, TwoHalvesOfOneTagAreTwoPatches) {
  cv::Mat picture = gray_floor();
  fill(picture, {100, 80, 14, 28}, kRedHue);
  fill(picture, {114, 80, 14, 28}, kBlueHue);
  picture(cv::Rect(20, 160, 280, 3)).setTo(cv::Scalar(210, 210, 210));  // a line of the field
  const std::vector<Patch> patches = by_x(find_patches(look_at(picture), 40));
  ASSERT_THAT(patches, SizeIs(2));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(patches[i].centroid_px.x, i == 0 ? 106.5 : 120.5, 0.2);
    EXPECT_NEAR(patches[i].centroid_px.y, 93.5, 0.2);
    EXPECT_NEAR(patches[i].area_px, 14.0 * 28.0, 6.0);
    EXPECT_NEAR(hue_difference(patches[i].hue, i == 0 ? kRedHue : kBlueHue), 0.0, 1.0);
    EXPECT_NEAR(patches[i].elongation(), 2.0, 0.1);
    EXPECT_EQ(patches[i].median_spread, 220);
    EXPECT_EQ(patches[i].companions, 1);
    EXPECT_EQ(static_cast<double>(patches[i].pixels.size()), patches[i].area_px);
  }
}

TEST(PatchFinder, AHueAroundZeroIsOnePatch) {
  cv::Mat picture = gray_floor();
  fill(picture, {50, 50, 20, 10}, 254);
  fill(picture, {50, 60, 20, 10}, 2);
  const std::vector<Patch> patches = find_patches(look_at(picture), 40);
  ASSERT_THAT(patches, SizeIs(1));
  EXPECT_LE(std::abs(hue_difference(patches[0].hue, 0.0)), 3.0);
  EXPECT_GE(patches[0].hue, 0.0);
  EXPECT_LT(patches[0].hue, 256.0);
  EXPECT_NEAR(patches[0].area_px, 400.0, 6.0);
}

TEST(PatchFinder, NoiseOfACameraMakesNoPatchOfATagsSize) {
  cv::Mat picture = gray_floor();
  cv::Mat noise(picture.size(), CV_16SC3);
  cv::RNG generator(7);
  generator.fill(noise, cv::RNG::NORMAL, 0.0, 8.0);
  cv::add(picture, noise, picture, cv::noArray(), CV_8UC3);
  for (const Patch& patch : find_patches(look_at(picture), 15)) EXPECT_LT(patch.area_px, 80.0);
}

TEST(PatchFinder, ATagInNoiseKeepsItsCentroid) {
  cv::Mat picture = gray_floor();
  fill(picture, {100, 80, 14, 28}, kRedHue);
  cv::Mat noise(picture.size(), CV_16SC3);
  cv::RNG generator(7);
  generator.fill(noise, cv::RNG::NORMAL, 0.0, 8.0);
  cv::add(picture, noise, picture, cv::noArray(), CV_8UC3);
  const std::vector<Patch> patches = find_patches(look_at(picture), 60);
  ASSERT_THAT(patches, SizeIs(1));
  EXPECT_LT(cv::norm(patches[0].centroid_px - cv::Point2d(106.5, 93.5)), 0.3);
}

TEST(PatchFinder, AWallIsNoPatch) {
  cv::Mat picture = gray_floor();
  fill(picture, {100, 80, 60, 60}, kRedHue);
  EXPECT_THAT(find_patches(look_at(picture), 40), IsEmpty());
}

TEST(PatchFinder, ACableIsNoPatch) {
  cv::Mat picture = gray_floor();
  fill(picture, {100, 80, 90, 4}, kRedHue);
  EXPECT_THAT(find_patches(look_at(picture), 40), IsEmpty());
}

TEST(PatchFinder, WhatIsNoMoreColouredThanTheThresholdIsNotLookedAt) {
  cv::Mat picture = gray_floor();
  picture(cv::Rect(50, 50, 20, 20)).setTo(cv::Scalar(60, 60, 100));
  EXPECT_THAT(find_patches(look_at(picture), 40), IsEmpty());
  EXPECT_THAT(find_patches(look_at(picture), 39), SizeIs(1));
}

TEST(PatchFinder, APictureOfOnePixelHoldsNothing) {
  EXPECT_THAT(find_patches(look_at(cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 255))), 40), IsEmpty());
}

}  // namespace
}  // namespace maggic::calibration
