#include "calibration/field_model.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace maggic::calibration {
namespace {

using ::testing::ElementsAre;

const ModelLine& line_named(const std::vector<ModelLine>& lines, std::string_view name) {
  return *std::ranges::find(lines, name, &ModelLine::name);
}

TEST(FieldModel, LinesLieWhereTheRulesOfTheSmallFieldHaveThem) {
  const FieldParameters field;
  EXPECT_THAT(line_places_mm(field, Direction::kUpright), ElementsAre(-750, -600, 0, 600, 750));
  EXPECT_THAT(line_places_mm(field, Direction::kLevel), ElementsAre(-650, -350, 350, 650));
  const auto lines = field_lines(field);
  for (const ModelPoint& p : line_named(lines, "top side").points) {
    EXPECT_EQ(p.position_mm.y, 650.0);
    EXPECT_LT(std::abs(p.position_mm.x), 680.0) << "the corner triangle";
  }
  for (const ModelPoint& p : line_named(lines, "left goal area").points) {
    EXPECT_EQ(p.position_mm.x, -600.0);
    EXPECT_LT(std::abs(p.position_mm.y), 350.0);
  }
  for (const ModelPoint& p : line_named(lines, "centre circle").points) {
    EXPECT_NEAR(cv::norm(p.position_mm), 200.0, 1e-9);
    EXPECT_NEAR(p.across.dot(p.position_mm), 200.0, 1e-9);
  }
}

TEST(FieldModel, FollowsTheSizeOfTheField) {
  FieldParameters field;
  field.length_mm = 2200.0;
  field.width_mm = 1800.0;
  EXPECT_THAT(line_places_mm(field, Direction::kUpright), ElementsAre(-1100, -950, 0, 950, 1100));
  const std::vector<ModelLine> lines = field_lines(field);
  for (const ModelPoint& p : line_named(lines, "right goal line").points) {
    EXPECT_EQ(p.position_mm.x, 1100.0);
  }
}

TEST(FieldModel, AcrossIsAUnitVectorAndPointsOutOfTheField) {
  int outlines = 0;
  for (const ModelLine& line : field_lines({})) {
    outlines += line.is_outline ? 1 : 0;
    ASSERT_FALSE(line.points.empty()) << line.name;
    for (const ModelPoint& p : line.points) {
      EXPECT_NEAR(cv::norm(p.across), 1.0, 1e-12) << line.name;
      if (!line.is_outline) continue;
      EXPECT_GT(p.across.dot(p.position_mm), 0.0) << line.name;
    }
  }
  EXPECT_EQ(outlines, 4);
}

TEST(FieldModel, IsTheSameUpsideDownAndFromTheOtherSide) {
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (const ModelLine& line : field_lines({})) {
    for (const ModelPoint& p : line.points) {
      sum_x += p.position_mm.x;
      sum_y += p.position_mm.y;
    }
  }
  EXPECT_NEAR(sum_x, 0.0, 1e-6);
  EXPECT_NEAR(sum_y, 0.0, 1e-6);
}

}  // namespace
}  // namespace maggic::calibration
