#include "calibration/field_finder.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace maggic::calibration {
namespace {

using Corners = std::array<cv::Point2d, 4>;
using ::testing::Contains;

const cv::Size kPicture{640, 480};
const Corners kUpright{{{64.5, 18.5}, {574.5, 18.5}, {574.5, 460.5}, {64.5, 460.5}}};
const Corners kOblique{{{61.2, 33.7}, {585.3, 24.6}, {607.9, 452.1}, {38.4, 441.3}}};

FieldParameters camera(const Corners& corners, double lens_k1 = 0.0) {
  FieldParameters field;
  field.corners_px.assign(corners.begin(), corners.end());
  field.image_size_px = kPicture;
  field.lens_k1 = lens_k1;
  return field;
}

/// The lines of a 3v3 field as this camera sees them: drawn four times too large, then shrunk, so
/// that they lie between pixels where they should.
class Drawing {
 public:
  explicit Drawing(const FieldParameters& field)
      : field_(field, kPicture), large_(kPicture * 4, CV_8UC3, cv::Scalar(60, 60, 60)) {
    add({-750, 650}, {750, 650});
    add({750, 650}, {750, -650});
    add({750, -650}, {-750, -650});
    add({-750, -650}, {-750, 650});
    add({0, -650}, {0, 650});
    for (const double side : {-1.0, 1.0}) {
      add({side * 750, 350}, {side * 600, 350});
      add({side * 600, 350}, {side * 600, -350});
      add({side * 600, -350}, {side * 750, -350});
    }
    for (int i = 0; i < 72; ++i) add(on_circle(i), on_circle(i + 1));
  }

  cv::Mat picture() const {
    cv::Mat small;
    cv::resize(large_, small, kPicture, 0.0, 0.0, cv::INTER_AREA);
    return small;
  }

 private:
  static cv::Point2d on_circle(int i) {
    const double angle = i * std::numbers::pi / 36.0;
    return {200.0 * std::cos(angle), 200.0 * std::sin(angle)};
  }
  cv::Point large_px(cv::Point2d mm) const {
    const cv::Point2d p = field_.to_image_px(mm, 0.0);
    return {cvRound(4.0 * p.x + 1.5), cvRound(4.0 * p.y + 1.5)};
  }
  /// In short pieces, for a lens bends it.
  void add(cv::Point2d from, cv::Point2d to) {
    const int pieces = std::max(1, static_cast<int>(cv::norm(to - from) / 25.0));
    for (int i = 0; i < pieces; ++i) {
      const auto at = [&](int k) { return from + (to - from) * (1.0 * k / pieces); };
      constexpr int kWidth = 7;  // of four times 1.75 px, 4.5 mm
      cv::line(large_, large_px(at(i)), large_px(at(i + 1)), cv::Scalar(190, 190, 190), kWidth);
    }
  }

  Field field_;
  cv::Mat large_;
};

void expect_corners(const FoundField& found, const Corners& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(cv::norm(found.corners_px[i] - corners[i]), 0.5)
        << "corner " << i << " at " << found.corners_px[i];
  }
}

TEST(FieldFinder, FindsAFieldSeenFromAbove) {
  const auto found = find_field(Drawing(camera(kUpright)).picture(), {}, TagMetric::of_scale(2.9));
  ASSERT_TRUE(found.has_value());
  expect_corners(*found, kUpright);
  EXPECT_EQ(found->lens_k1, 0.0) << "straight lines need no lens";
  EXPECT_LT(found->error_px, 0.5);
  EXPECT_GT(found->seen_share, 0.9);
  EXPECT_THAT(found->lines, Contains("centre circle"));
}

TEST(FieldFinder, FindsAFieldSeenFromTheSide) {
  const auto found = find_field(Drawing(camera(kOblique)).picture(), {}, TagMetric::of_scale(2.6));
  ASSERT_TRUE(found.has_value());
  expect_corners(*found, kOblique);
}

TEST(FieldFinder, FindsTheLensThatBendsTheLines) {
  for (const double k1 : {-0.15, 0.1}) {
    const auto found =
        find_field(Drawing(camera(kUpright, k1)).picture(), {}, TagMetric::of_scale(2.8));
    ASSERT_TRUE(found.has_value()) << k1;
    EXPECT_NEAR(found->lens_k1, k1, 0.03);
    expect_corners(*found, kUpright);
  }
}

TEST(FieldFinder, TheCornersKnownSoFarDoNotMatter) {
  FieldParameters elsewhere = camera({{{1, 1}, {99, 1}, {99, 99}, {1, 99}}}, 0.3);
  elsewhere.image_size_px = {100, 100};
  const auto found =
      find_field(Drawing(camera(kUpright)).picture(), elsewhere, TagMetric::of_scale(2.9));
  ASSERT_TRUE(found.has_value());
  expect_corners(*found, kUpright);
}

TEST(FieldFinder, FindsNothingWhereThereIsNothing) {
  const cv::Mat empty(kPicture, CV_8UC3, cv::Scalar(60, 60, 60));
  EXPECT_FALSE(find_field(empty, {}, TagMetric::of_scale(2.9)).has_value());
}

TEST(FieldFinder, FindsNothingInNoise) {
  cv::Mat noise(kPicture / 2, CV_8UC3);
  cv::RNG generator(3);
  generator.fill(noise, cv::RNG::NORMAL, 90.0, 12.0);
  EXPECT_FALSE(find_field(noise, {}, TagMetric::of_scale(5.8)).has_value());
}

TEST(FieldFinder, FindsNothingWhenTagsAreOfAnotherSizeThanTheLinesAllow) {
  const cv::Mat picture = Drawing(camera(kUpright)).picture();
  EXPECT_FALSE(find_field(picture, {}, TagMetric::of_scale(9.0)).has_value());
}

TEST(FieldFinder, FindsNothingInAPictureOfOnePixel) {
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(60, 60, 60));
  EXPECT_FALSE(find_field(pixel, {}, TagMetric::of_scale(2.9)).has_value());
}

}  // namespace
}  // namespace maggic::calibration
