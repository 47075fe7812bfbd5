#include "calibration/tag_metric.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::calibration {
namespace {

/// Half-tags 35 mm apart, a robot every so many degrees, as seen by a camera.
std::vector<KnownDistance> robots(int count, double degrees_apart, cv::Point2d px_per_mm) {
  std::vector<KnownDistance> distances;
  for (int i = 0; i < count; ++i) {
    const double angle = i * degrees_apart * std::numbers::pi / 180.0;
    distances.push_back(
        {{35.0 * std::cos(angle) * px_per_mm.x, 35.0 * std::sin(angle) * px_per_mm.y}, 35.0});
  }
  return distances;
}

TEST(TagMetric, OfOneScaleMeasuresAlikeInEveryDirection) {
  const TagMetric metric = TagMetric::of_scale(2.0);
  EXPECT_DOUBLE_EQ(metric.length_mm({3.0, 4.0}), 10.0);
  EXPECT_DOUBLE_EQ(metric.length_mm({0.0, -1.0}), 2.0);
  EXPECT_DOUBLE_EQ(metric.pixel_mm2(), 4.0);
  EXPECT_DOUBLE_EQ(metric.mm_per_px()(0, 0), 2.0);
  EXPECT_DOUBLE_EQ(metric.mm_per_px()(0, 1), 0.0);
}

TEST(TagMetric, OfAStretchedPictureMeasuresEachAxisByItsOwnScale) {
  const TagMetric metric{{9.0, 0.0, 0.0, 4.0}};
  EXPECT_DOUBLE_EQ(metric.length_mm({1.0, 0.0}), 3.0);
  EXPECT_DOUBLE_EQ(metric.length_mm({0.0, 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(metric.pixel_mm2(), 6.0);
}

TEST(TagMetricFit, FindsTheScaleOfAnIsotropicPicture) {
  const TagMetric metric = fit_metric(robots(7, 50.0, {0.4, 0.4}));
  EXPECT_NEAR(metric.mm_per_px()(0, 0), 2.5, 1e-9);
  EXPECT_NEAR(metric.mm_per_px()(1, 1), 2.5, 1e-9);
}

TEST(TagMetricFit, FindsTheStretchOfAPictureBroughtFrom4To3To16To9) {
  const double wide = (16.0 / 9.0) / (4.0 / 3.0);
  const TagMetric metric = fit_metric(robots(24, 15.0, {0.4 * wide, 0.4}));
  EXPECT_NEAR(metric.mm_per_px()(0, 0) * 0.4 * wide, 1.0, 0.03);
  EXPECT_NEAR(metric.mm_per_px()(1, 1) * 0.4, 1.0, 0.03);
}

TEST(TagMetricFit, RobotsThatAllPointOneWayTellOfNoStretch) {
  const TagMetric metric = fit_metric(robots(30, 0.0, {0.5, 0.3}));
  EXPECT_NEAR(metric.mm_per_px()(0, 0), 2.0, 1e-9);
  EXPECT_NEAR(metric.mm_per_px()(1, 1), 2.0, 1e-9);
}

TEST(TagMetricFit, OneDistanceIsEnoughForAScale) {
  EXPECT_NEAR(fit_metric(robots(1, 0.0, {0.5, 0.5})).pixel_mm2(), 4.0, 1e-9);
}

TEST(TagMetricFit, AStretchNoPictureHasIsNotBelieved) {
  std::vector<KnownDistance> distances(21, {{35.0, 0.0}, 35.0});
  distances.resize(41, {{0.0, 350.0}, 35.0});
  const TagMetric metric = fit_metric(distances);
  EXPECT_EQ(metric.mm2_per_px2(0, 0), metric.mm2_per_px2(1, 1));
}

TEST(TagMetricFit, AFewWrongDistancesChangeLittle) {
  std::vector<KnownDistance> distances = robots(40, 9.0, {0.4, 0.4});
  distances.push_back({{17.0, 0.0}, 35.0});
  distances.push_back({{0.0, 11.5}, 35.0});
  const TagMetric metric = fit_metric(distances);
  EXPECT_NEAR(metric.mm_per_px()(0, 0) / 2.5, 1.0, 0.03);
  EXPECT_NEAR(metric.mm_per_px()(1, 1) / 2.5, 1.0, 0.03);
}

RC_GTEST_PROP(TagMetricFitProperty, AnyIsotropicScaleComesBackFromAnyDirections, ()) {
  const double px_per_mm = *rc::gen::inRange(50, 5000) / 1000.0;
  const int count = *rc::gen::inRange(1, 30);
  const double apart = *rc::gen::inRange(0, 360);
  const TagMetric metric = fit_metric(robots(count, apart, {px_per_mm, px_per_mm}));
  RC_ASSERT(std::abs(metric.length_mm({px_per_mm, 0.0}) - 1.0) < 1e-6);
  RC_ASSERT(std::abs(metric.length_mm({0.0, px_per_mm}) - 1.0) < 1e-6);
}

RC_GTEST_PROP(TagMetricFitProperty, IsAlwaysPositive, ()) {
  std::vector<KnownDistance> distances;
  const int count = *rc::gen::inRange(1, 12);
  for (int i = 0; i < count; ++i) {
    distances.push_back({{*rc::gen::inRange(-60, 60) + 0.5, *rc::gen::inRange(-60, 60) + 0.5},
                         *rc::gen::inRange(10, 80) + 0.0});
  }
  const TagMetric metric = fit_metric(distances);
  RC_ASSERT(metric.mm2_per_px2(0, 0) > 0.0);
  RC_ASSERT(metric.mm2_per_px2(1, 1) > 0.0);
  RC_ASSERT(std::isfinite(metric.pixel_mm2()));
}

}  // namespace
}  // namespace maggic::calibration
