#include "maggic/field_area.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using ::testing::Eq;

const cv::Size kSize(640, 480);

/// A 3v3 field of 450 × 390 px, 0.3 px a mm, seen from straight above.
FieldParameters seen_from_above() {
  FieldParameters parameters;
  parameters.corners_px = {{95, 45}, {545, 45}, {545, 435}, {95, 435}};
  return parameters;
}

TEST(FieldArea, IsTheWholePictureWhileTheCornersAreNotKnown) {
  EXPECT_THAT(field_area(Field(FieldParameters(), kSize), 0.0), Eq(whole_picture(kSize)));
}

TEST(FieldArea, LeavesOutWhatLiesBeyondTheMargin) {
  FieldParameters parameters = seen_from_above();
  parameters.robot_height_mm = 0.0;
  parameters.ball_height_mm = 0.0;
  const ScanArea area = field_area(Field(parameters, kSize), 100.0);
  // 30 px of margin, and at most two more.
  EXPECT_NEAR(area.front().row, 15, 2);
  EXPECT_NEAR(area.back().row, 465, 2);
  for (const RowSpan& span : area) {
    EXPECT_NEAR(span.begin, 65, 2);
    EXPECT_NEAR(span.end, 576, 2);
  }
}

TEST(FieldArea, TakesInTagsThatLeanOutwards) {
  const Field field(seen_from_above(), kSize);
  const cv::Point2d tag = field.to_image_px({-750.0, 0.0}, field.robot_height_mm());
  EXPECT_LT(tag.x, 94.0);
  EXPECT_TRUE(holds(field_area(field, 0.0), tag));
}

TEST(FieldArea, IsCutAtThePicturesEdges) {
  const ScanArea area = field_area(Field(seen_from_above(), kSize), 5000.0);
  EXPECT_THAT(area, Eq(whole_picture(kSize)));
}

TEST(FieldArea, IsEmptyWhereTheFieldIsOutOfThePicture) {
  FieldParameters parameters = seen_from_above();
  for (cv::Point2d& corner : parameters.corners_px) corner.y += 5000.0;
  EXPECT_TRUE(field_area(Field(parameters, kSize), 100.0).empty());
}

TEST(FieldArea, HoldsTagsOfEveryHeightAboveTheCornersForACameraBesideTheField) {
  FieldParameters parameters = seen_from_above();
  parameters.robot_height_mm = 200.0;
  parameters.camera_position_mm = {-2500.0, 650.0};
  const Field field(parameters, kSize);
  const ScanArea area = field_area(field, 0.0);
  for (const cv::Point2d corner :
       {cv::Point2d(-750.0, 650.0), {750.0, 650.0}, {750.0, -650.0}, {-750.0, -650.0}}) {
    for (double height_mm = 0.0; height_mm <= 200.0; height_mm += 10.0) {
      const cv::Point2d tag = field.to_image_px(corner, height_mm);
      if (!cv::Rect2d({}, kSize).contains(tag)) continue;
      EXPECT_TRUE(holds(area, {cvRound(tag.x), cvRound(tag.y)}))
          << corner.x << ", " << corner.y << " at " << height_mm;
    }
  }
}

TEST(FieldArea, TellsHowFarBeyondTheLinesAPixelLies) {
  FieldParameters parameters = seen_from_above();
  const Field field(parameters, kSize);
  EXPECT_EQ(beyond_lines_mm(field, {320, 240}), 0.0);
  EXPECT_EQ(beyond_lines_mm(field, {95.5, 45.5}), 0.0);
  const double top_mm = field.robot_height_mm();
  EXPECT_NEAR(beyond_lines_mm(field, field.to_image_px({0.0, -750.0}, top_mm)), 100.0, 1e-6);
  EXPECT_NEAR(beyond_lines_mm(field, field.to_image_px({-800.0, 900.0}, top_mm)), 250.0, 1e-6);
  parameters.camera_position_mm = {3000.0, 0.0};  // what is high now leans inwards on this side
  const Field from_the_side(parameters, kSize);
  EXPECT_NEAR(beyond_lines_mm(from_the_side, from_the_side.to_image_px({900.0, 0.0}, 0.0)), 150.0,
              1e-6);
}

RC_GTEST_PROP(FieldArea, TakesInAPixelFromTheMarginOnThatReachesIt, ()) {
  FieldParameters parameters = seen_from_above();
  for (cv::Point2d& corner : parameters.corners_px) {
    corner += cv::Point2d(*rc::gen::inRange(-40, 40), *rc::gen::inRange(-40, 40));
  }
  parameters.lens_k1 = *rc::gen::inRange(-30, 10) / 100.0;
  const Field field(parameters, kSize);
  const cv::Point pixel(*rc::gen::inRange(0, kSize.width), *rc::gen::inRange(0, kSize.height));
  const double beyond_mm = beyond_lines_mm(field, pixel);
  RC_ASSERT(holds(field_area(field, beyond_mm), pixel));
  // A few pixels less is too little; a pixel is about 3 mm in the middle, more where lens and
  // perspective crowd the field together.
  const double few_px_mm = 4.0 * cv::norm(field.jacobian_mm_per_px(pixel, 0.0));
  if (beyond_mm > few_px_mm) RC_ASSERT(!holds(field_area(field, beyond_mm - few_px_mm), pixel));
}

RC_GTEST_PROP(FieldArea, HoldsEveryPixelThatSeesTheFieldThroughAnyLens, ()) {
  FieldParameters parameters = seen_from_above();
  for (cv::Point2d& corner : parameters.corners_px) {
    corner += cv::Point2d(*rc::gen::inRange(-40, 40), *rc::gen::inRange(-40, 40));
  }
  parameters.lens_k1 = *rc::gen::inRange(-30, 10) / 100.0;
  // Above the field or beside it.
  parameters.camera_position_mm = {*rc::gen::inRange(-3000, 3001) * 1.0,
                                   *rc::gen::inRange(-3000, 3001) * 1.0};
  const Field field(parameters, kSize);
  const double margin_mm = *rc::gen::inRange(0, 300);
  const ScanArea area = field_area(field, margin_mm);
  const cv::Point2d position_mm((750.0 + margin_mm) * *rc::gen::inRange(-1000, 1001) / 1000.0,
                                (650.0 + margin_mm) * *rc::gen::inRange(-1000, 1001) / 1000.0);
  const double height_mm = field.robot_height_mm() * *rc::gen::inRange(0, 101) / 100.0;
  const cv::Point2d point = field.to_image_px(position_mm, height_mm);
  const cv::Point pixel(cvRound(point.x), cvRound(point.y));
  RC_PRE(cv::Rect({}, kSize).contains(pixel));
  RC_ASSERT(holds(area, pixel));
}

}  // namespace
}  // namespace maggic
