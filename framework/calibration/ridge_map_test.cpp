#include "calibration/ridge_map.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace maggic::calibration {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kFloor = 50;
constexpr int kLine = 200;

cv::Mat floor_of(int width = 200, int height = 160) {
  return {height, width, CV_8UC1, cv::Scalar(kFloor)};
}

/// A line of `width_px` with its place in the middle row given, as in SeenLine; rims are mixed.
void draw_upright(cv::Mat& gray, double position_px, double slope, double width_px) {
  for (int y = 0; y < gray.rows; ++y) {
    const double middle = position_px + slope * (y - (gray.rows - 1) / 2.0);
    for (int x = 0; x < gray.cols; ++x) {
      const double inside =
          std::min(x + 0.5, middle + width_px / 2.0) - std::max(x - 0.5, middle - width_px / 2.0);
      if (inside <= 0.0) continue;
      gray.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(kFloor + inside * (kLine - kFloor));
    }
  }
}

TEST(RidgeMap, IsAsHighAsTheLineIsBrighterThanTheFloor) {
  cv::Mat gray = floor_of();
  draw_upright(gray, 50.0, 0.0, 3.0);
  const RidgeMap ridges = make_ridge_map(gray, 8);
  EXPECT_EQ(ridges.upright.at<std::uint8_t>(80, 50), kLine - kFloor);
  EXPECT_EQ(ridges.upright.at<std::uint8_t>(80, 90), 0);
  EXPECT_EQ(ridges.level.at<std::uint8_t>(80, 50), 0) << "nothing is brighter along the line";
}

TEST(RidgeMap, AnEdgeIsNoRidge) {
  cv::Mat gray = floor_of();
  gray.colRange(100, 200).setTo(kLine);
  gray.rowRange(0, 40).setTo(kLine);
  const RidgeMap ridges = make_ridge_map(gray, 8);
  EXPECT_EQ(cv::countNonZero(ridges.upright), 0);
  EXPECT_EQ(cv::countNonZero(ridges.level), 0);
}

TEST(RidgeMap, WhatIsWiderThanAskedForIsNoRidge) {
  cv::Mat gray = floor_of();
  draw_upright(gray, 50.0, 0.0, 20.0);
  EXPECT_EQ(cv::countNonZero(make_ridge_map(gray, 8).upright), 0);
  EXPECT_GT(cv::countNonZero(make_ridge_map(gray, 32).upright), 0);
}

TEST(SeenLines, HaveTheirPlaceAndSlope) {
  for (const double slope : {0.0, 0.08, -0.2}) {
    cv::Mat gray = floor_of();
    draw_upright(gray, 90.3, slope, 3.0);
    const auto lines = find_lines(make_ridge_map(gray, 8), Direction::kUpright, 20, 60.0);
    ASSERT_FALSE(lines.empty()) << slope;
    EXPECT_NEAR(lines[0].position_px, 90.3, 1.0) << slope;
    EXPECT_NEAR(lines[0].slope, slope, 0.015) << slope;
    EXPECT_GT(lines[0].length_px, 120.0) << slope;
  }
}

TEST(SeenLines, OfTheOtherDirectionAreTheSameTurned) {
  cv::Mat gray = floor_of(160, 200);
  draw_upright(gray, 70.0, 0.05, 3.0);
  const cv::Mat turned = gray.t();
  const auto upright = find_lines(make_ridge_map(gray, 8), Direction::kUpright, 20, 60.0);
  const auto level = find_lines(make_ridge_map(turned, 8), Direction::kLevel, 20, 60.0);
  ASSERT_FALSE(upright.empty());
  ASSERT_FALSE(level.empty());
  EXPECT_NEAR(upright[0].position_px, level[0].position_px, 1.0);
  EXPECT_NEAR(upright[0].slope, level[0].slope, 0.01);
  EXPECT_THAT(find_lines(make_ridge_map(gray, 8), Direction::kLevel, 20, 60.0), IsEmpty());
}

TEST(SeenLines, AreParallelOnesApart) {
  cv::Mat gray = floor_of();
  draw_upright(gray, 40.0, 0.0, 3.0);
  draw_upright(gray, 60.0, 0.0, 3.0);
  EXPECT_THAT(find_lines(make_ridge_map(gray, 8), Direction::kUpright, 20, 60.0), SizeIs(2));
}

TEST(SeenLines, AreLongAndOfContrastOrNone) {
  cv::Mat gray = floor_of();
  draw_upright(gray, 40.0, 0.0, 3.0);
  gray.rowRange(60, gray.rows).setTo(kFloor);
  const RidgeMap ridges = make_ridge_map(gray, 8);
  EXPECT_THAT(find_lines(ridges, Direction::kUpright, 20, 100.0), IsEmpty());
  EXPECT_THAT(find_lines(ridges, Direction::kUpright, kLine - kFloor + 1, 40.0), IsEmpty());
  EXPECT_THAT(find_lines(ridges, Direction::kUpright, 20, 40.0), SizeIs(1));
}

TEST(SeenLines, ThatLeanByMoreThanTwentyDegreesAreOfNeitherDirection) {
  cv::Mat gray = floor_of();
  draw_upright(gray, 100.0, 0.6, 3.0);
  const RidgeMap ridges = make_ridge_map(gray, 8);
  EXPECT_THAT(find_lines(ridges, Direction::kUpright, 20, 60.0), IsEmpty());
  EXPECT_THAT(find_lines(ridges, Direction::kLevel, 20, 60.0), IsEmpty());
}

TEST(SeenLines, APictureOfOnePixelHasNone) {
  const RidgeMap ridges = make_ridge_map(cv::Mat(1, 1, CV_8UC1, cv::Scalar(255)), 8);
  EXPECT_THAT(find_lines(ridges, Direction::kLevel, 1, 4.0), IsEmpty());
}

}  // namespace
}  // namespace maggic::calibration
