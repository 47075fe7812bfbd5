#include "maggic/field.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const cv::Size kVga{640, 480};

#define EXPECT_POINT(actual, expected_x, expected_y, tolerance) \
  do {                                                          \
    const cv::Point2d point_ = (actual);                        \
    EXPECT_NEAR(point_.x, expected_x, tolerance);               \
    EXPECT_NEAR(point_.y, expected_y, tolerance);               \
  } while (false)

FieldParameters with_corners(std::vector<cv::Point2d> corners) {
  FieldParameters parameters;
  parameters.corners_px = std::move(corners);
  return parameters;
}

/// Seen from above and somewhat from the side, as cameras hang in practice.
FieldParameters oblique() {
  FieldParameters parameters = with_corners({{60, 40}, {585, 25}, {610, 455}, {35, 440}});
  parameters.lens_k1 = -0.18;
  parameters.lens_k2 = 0.03;
  parameters.focal_length_px = 520.0;
  parameters.principal_point_px = cv::Point2d(315.0, 244.0);
  parameters.camera_position_mm = {60.0, -40.0};
  return parameters;
}

double in_range(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 1'000'001) / 1e6);
}

cv::Point2d pixel_in(cv::Size size) {
  return {in_range(-0.5, size.width - 0.5), in_range(-0.5, size.height - 0.5)};
}

FieldParameters any_parameters() {
  FieldParameters parameters = with_corners({{in_range(20, 120), in_range(10, 90)},
                                             {in_range(520, 620), in_range(10, 90)},
                                             {in_range(520, 620), in_range(390, 470)},
                                             {in_range(20, 120), in_range(390, 470)}});
  parameters.lens_k1 = in_range(-0.4, 0.4);
  parameters.lens_k2 = in_range(-0.1, 0.1);
  parameters.camera_height_mm = in_range(1500.0, 4000.0);
  parameters.camera_position_mm = {in_range(-500.0, 500.0), in_range(-500.0, 500.0)};
  parameters.half_time = *rc::gen::arbitrary<bool>();
  return parameters;
}

TEST(Field, WithoutCornersFitsTheFieldIntoThePicture) {
  const FieldParameters parameters;  // 1500 x 1300 in 640 x 480: the height decides
  const double scale = 480.0 / 1300.0;
  const Field field(parameters, kVga);
  EXPECT_POINT(field.to_field_mm({319.5, 239.5}, 0.0), 0.0, 0.0, 1e-9);
  EXPECT_POINT(field.to_image_px({0.0, 650.0}, 0.0), 319.5, -0.5, 1e-9);
  EXPECT_POINT(field.to_image_px({750.0, -650.0}, 0.0), 319.5 + 750.0 * scale, 479.5, 1e-9);
}

TEST(Field, FittedCornersLeaveTheMargin) {
  const std::vector<cv::Point2d> corners = fitted_corners_px(FieldParameters{}, kVga, 19.0);
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_POINT(corners[0], 64.5, 18.5, 1e-9);
  EXPECT_POINT(corners[1], 574.5, 18.5, 1e-9);
  EXPECT_POINT(corners[2], 574.5, 460.5, 1e-9);
  EXPECT_POINT(corners[3], 64.5, 460.5, 1e-9);
}

TEST(Field, MapsCornersInTheirOrderWithYUp) {
  const Field field(with_corners({{60, 40}, {585, 25}, {610, 455}, {35, 440}}), kVga);
  EXPECT_POINT(field.to_field_mm({60, 40}, 0.0), -750.0, 650.0, 1e-9);
  EXPECT_POINT(field.to_field_mm({585, 25}, 0.0), 750.0, 650.0, 1e-9);
  EXPECT_POINT(field.to_field_mm({610, 455}, 0.0), 750.0, -650.0, 1e-9);
  EXPECT_POINT(field.to_field_mm({35, 440}, 0.0), -750.0, -650.0, 1e-9);
}

TEST(Field, MapsCornersThroughTheLens) {
  const Field field(oblique(), kVga);
  EXPECT_POINT(field.to_field_mm({60, 40}, 0.0), -750.0, 650.0, 1e-6);
  EXPECT_POINT(field.to_field_mm({610, 455}, 0.0), 750.0, -650.0, 1e-6);
}

TEST(Field, KeepsStraightLinesStraightUnderPerspective) {
  // The diagonals of a rectangle meet at its centre, in the picture too.
  const Field field(with_corners({{100, 50}, {540, 50}, {620, 450}, {20, 450}}), kVga);
  const double y = 50.0 + 400.0 * 440.0 / (440.0 + 600.0);
  EXPECT_POINT(field.to_field_mm({320, y}, 0.0), 0.0, 0.0, 1e-9);
}

TEST(Field, BringsHighObjectsBackTowardsTheCamera) {
  FieldParameters parameters;
  parameters.camera_height_mm = 2000.0;
  const Field field(parameters, kVga);
  // Seen at 500 mm on the floor, 75 mm high: 500 * (1 - 75/2000).
  const cv::Point2d seen = field.to_image_px({500.0, -200.0}, 0.0);
  EXPECT_POINT(field.to_field_mm(seen, 75.0), 481.25, -192.5, 1e-9);
}

TEST(Field, ParallaxVanishesBelowTheCamera) {
  FieldParameters parameters;
  parameters.camera_position_mm = {300.0, 100.0};
  const Field field(parameters, kVga);
  const cv::Point2d below = field.to_image_px({300.0, 100.0}, 0.0);
  EXPECT_POINT(field.to_field_mm(below, 75.0), 300.0, 100.0, 1e-9);
}

TEST(Field, HalfTimeTurnsEverythingByHalfATurn) {
  FieldParameters parameters = oblique();
  const Field first(parameters, kVga);
  parameters.half_time = true;
  const Field second(parameters, kVga);
  const cv::Point2d before = first.to_field_mm({200, 150}, 75.0);
  EXPECT_POINT(second.to_field_mm({200, 150}, 75.0), -before.x, -before.y, 1e-9);
}

TEST(Field, ScalesCornersAndLensWithTheFrame) {
  FieldParameters parameters = oblique();
  parameters.image_size_px = kVga;
  const Field small(parameters, kVga);
  const Field large(parameters, {1280, 960});
  // Pixel centres are at integers, so doubling maps x to 2x + 0.5.
  const cv::Point2d expected = small.to_field_mm({200, 150}, 75.0);
  EXPECT_POINT(large.to_field_mm({400.5, 300.5}, 75.0), expected.x, expected.y, 1e-8);
}

TEST(Field, ScalesEachAxisByItself) {
  FieldParameters parameters = oblique();
  parameters.image_size_px = kVga;
  const Field field(parameters, {320, 480});
  const cv::Point2d expected = Field(parameters, kVga).to_field_mm({200, 150}, 0.0);
  EXPECT_POINT(field.to_field_mm({99.75, 150}, 0.0), expected.x, expected.y, 1e-8);
}

TEST(Field, TellsTheAreaOfAPixel) {
  const Field field(FieldParameters{}, kVga);
  const double mm_per_px = 1300.0 / 480.0;
  EXPECT_NEAR(field.mm2_per_px2({100, 100}, 0.0), mm_per_px * mm_per_px, 1e-9);
}

TEST(Field, AcceptsAPictureOfOnePixel) {
  const Field field(FieldParameters{}, {1, 1});
  EXPECT_POINT(field.to_field_mm({0.0, 0.0}, 75.0), 0.0, 0.0, 1e-9);
}

TEST(Field, StaysFiniteBeyondTheHorizon) {
  // So oblique that the horizon, y = 100, is inside the picture.
  const Field field(with_corners({{310, 110}, {330, 110}, {638, 470}, {2, 470}}), kVga);
  for (double y = 0.0; y < 480.0; y += 0.25) {
    const cv::Point2d p = field.to_field_mm({400.0, y}, 75.0);
    const cv::Matx22d j = field.jacobian_mm_per_px({400.0, y}, 75.0);
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << y;
    ASSERT_TRUE(std::isfinite(j(0, 0)) && std::isfinite(j(1, 1))) << y;
  }
}

TEST(Field, NamesWhatIsWrongWithCorners) {
  const auto making = [](std::vector<cv::Point2d> corners) {
    return [corners] { Field(with_corners(corners), kVga); };
  };
  using E = std::invalid_argument;
  EXPECT_THAT(making({{0, 0}, {9, 0}, {9, 9}}), ThrowsMessage<E>(HasSubstr("3 corners given")));
  EXPECT_THAT(making({{0, 0}, {9, 9}, {9, 0}, {0, 9}}), ThrowsMessage<E>(HasSubstr("convex")));
  EXPECT_THAT(making({{0, 0}, {0, 9}, {9, 9}, {9, 0}}),
              ThrowsMessage<E>(HasSubstr("counter-clockwise")));
  EXPECT_THAT(making({{9, 9}, {0, 9}, {0, 0}, {9, 0}}),
              ThrowsMessage<E>(HasSubstr("another corner")));
  EXPECT_THAT(making({{9, 0}, {9, 9}, {0, 9}, {0, 0}}),
              ThrowsMessage<E>(HasSubstr("another corner")));
  EXPECT_THAT(making({{0, 0}, {5, 0}, {9, 0}, {0, 9}}), ThrowsMessage<E>(HasSubstr("one line")));
  EXPECT_THAT(making({{0, 0}, {0, 0}, {9, 9}, {0, 9}}), ThrowsMessage<E>(HasSubstr("coincide")));
  EXPECT_THAT(making({{0, 0}, {NAN, 0}, {9, 9}, {0, 9}}), ThrowsMessage<E>(HasSubstr("finite")));
}

TEST(Field, RefusesObjectsAsHighAsTheCamera) {
  FieldParameters parameters;
  parameters.camera_height_mm = 75.0;
  EXPECT_THAT([&] { Field(parameters, kVga); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("lower than the camera")));
  EXPECT_THROW(Field(FieldParameters{}, cv::Size(0, 480)), std::invalid_argument);
}

RC_GTEST_PROP(Field, PixelsRoundTrip, ()) {
  const Field field(any_parameters(), kVga);
  const cv::Point2d pixel = pixel_in(kVga);
  const double height = in_range(0.0, 200.0);
  const cv::Point2d back = field.to_image_px(field.to_field_mm(pixel, height), height);
  RC_ASSERT(std::hypot(back.x - pixel.x, back.y - pixel.y) < 1e-6);
}

RC_GTEST_PROP(Field, PositionsRoundTrip, ()) {
  const Field field(any_parameters(), kVga);
  const cv::Point2d position(in_range(-750.0, 750.0), in_range(-650.0, 650.0));
  const cv::Point2d back = field.to_field_mm(field.to_image_px(position, 75.0), 75.0);
  RC_ASSERT(std::hypot(back.x - position.x, back.y - position.y) < 1e-6);
}

RC_GTEST_PROP(Field, JacobianIsTheDerivative, ()) {
  const Field field(any_parameters(), kVga);
  const cv::Point2d pixel = pixel_in(kVga);
  const cv::Matx22d j = field.jacobian_mm_per_px(pixel, 75.0);
  const double step = 1e-3;
  const cv::Point2d along_x = (field.to_field_mm(pixel + cv::Point2d(step, 0.0), 75.0) -
                               field.to_field_mm(pixel - cv::Point2d(step, 0.0), 75.0)) /
                              (2.0 * step);
  const cv::Point2d along_y = (field.to_field_mm(pixel + cv::Point2d(0.0, step), 75.0) -
                               field.to_field_mm(pixel - cv::Point2d(0.0, step), 75.0)) /
                              (2.0 * step);
  const cv::Matx22d numeric(along_x.x, along_y.x, along_x.y, along_y.y);
  RC_ASSERT(cv::norm(j - numeric) <= 1e-6 * cv::norm(j));
}

RC_GTEST_PROP(Field, IsFiniteForEveryLens, ()) {
  FieldParameters parameters;
  parameters.lens_k1 = in_range(-5.0, 5.0);
  parameters.lens_k2 = in_range(-5.0, 5.0);
  const cv::Size size{1 + *rc::gen::inRange(0, 2000), 1 + *rc::gen::inRange(0, 2000)};
  const Field field(parameters, size);
  const cv::Point2d p = field.to_field_mm(pixel_in(size), in_range(0.0, 3000.0));
  RC_ASSERT(std::isfinite(p.x) && std::isfinite(p.y));
}

}  // namespace
}  // namespace maggic
