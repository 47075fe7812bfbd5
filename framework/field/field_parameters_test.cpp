#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/document.hpp"
#include "maggic/field.hpp"
#include "maggic/parameter_reader.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Reading {
  FieldParameters field;
  std::vector<std::string> mistakes;
};

Reading read(std::string_view yaml) {
  Reading reading;
  std::vector<Mistake> mistakes;
  read_parameters(parse_document(yaml, "field.yaml"), Palette::standard(),
                  [&](Parameters& p) { reading.field.describe(p); }, mistakes);
  for (const Mistake& mistake : mistakes) reading.mistakes.push_back(mistake.to_string());
  return reading;
}

TEST(FieldParameters, FormatSetsBothLengths) {
  const Reading reading = read("format: 5v5");
  EXPECT_THAT(reading.mistakes, IsEmpty());
  EXPECT_EQ(reading.field.length_mm, 2200.0);
  EXPECT_EQ(reading.field.width_mm, 1800.0);
}

TEST(FieldParameters, LengthsBesideFormatHaveTheLastWord) {
  const Reading reading = read("length_mm: 2150\nformat: 5v5");
  EXPECT_THAT(reading.mistakes, IsEmpty());
  EXPECT_EQ(reading.field.length_mm, 2150.0);
  EXPECT_EQ(reading.field.width_mm, 1800.0);
}

TEST(FieldParameters, ReadsEveryKey) {
  const Reading reading = read(R"(
format: 3v3
corners_px: [[60, 40], [585, 25], [610, 455], [35, 440]]
image_size_px: [640, 480]
lens: {k1: -0.2, k2: 0.03, focal_length_px: 520, principal_point_px: [315, 244]}
camera: {height_mm: 2300, position_mm: [10, -20]}
robot_height_mm: 80
ball_height_mm: 20
half_time: true
)");
  EXPECT_THAT(reading.mistakes, IsEmpty());
  const FieldParameters& field = reading.field;
  EXPECT_THAT(field.corners_px, ElementsAre(cv::Point2d(60, 40), cv::Point2d(585, 25),
                                            cv::Point2d(610, 455), cv::Point2d(35, 440)));
  EXPECT_EQ(field.image_size_px, cv::Size(640, 480));
  EXPECT_EQ(field.lens_k1, -0.2);
  EXPECT_EQ(field.lens_k2, 0.03);
  EXPECT_EQ(field.focal_length_px, 520.0);
  EXPECT_EQ(field.principal_point_px, cv::Point2d(315, 244));
  EXPECT_EQ(field.camera_height_mm, 2300.0);
  EXPECT_EQ(field.camera_position_mm, cv::Point2d(10, -20));
  EXPECT_EQ(field.robot_height_mm, 80.0);
  EXPECT_EQ(field.ball_height_mm, 20.0);
  EXPECT_TRUE(field.half_time);
}

TEST(FieldParameters, CornerMistakesHaveTheirPlace) {
  const Reading crossed = read("format: 3v3\ncorners_px: [[0, 0], [9, 9], [9, 0], [0, 9]]");
  ASSERT_EQ(crossed.mistakes.size(), 1u);
  EXPECT_THAT(crossed.mistakes[0], HasSubstr("field.yaml:2:"));
  EXPECT_THAT(crossed.mistakes[0], HasSubstr("convex"));
  EXPECT_THAT(read("corners_px: [[0, 0], [9, 0], [9, 9]]").mistakes,
              ElementsAre(HasSubstr("3 corners given")));
}

TEST(FieldParameters, RefusesImpossibleSizes) {
  EXPECT_THAT(read("image_size_px: [640.5, 480]").mistakes, ElementsAre(HasSubstr("whole")));
  EXPECT_THAT(read("image_size_px: [640, 0]").mistakes, ElementsAre(HasSubstr("at least 1")));
  EXPECT_THAT(read("camera: {height_mm: 100}\nrobot_height_mm: 120").mistakes,
              ElementsAre(HasSubstr("as high as the camera")));
}

}  // namespace
}  // namespace maggic
