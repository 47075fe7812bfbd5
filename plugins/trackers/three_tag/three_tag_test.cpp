#include "maggic/testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/config_error.hpp"
#include "maggic/tracker.hpp"

namespace maggic {
namespace {

/// A picture of a field of its own shape, so that a pixel is a square of 2.5 mm.
class ThreeTagTest : public ::testing::Test {
 protected:
  void add(std::string_view color, cv::Point2d center_mm, cv::Size2d size_mm) {
    Blob blob;
    blob.label = *testing::standard_palette().find(color);
    blob.centroid_px = field_.to_image_px(center_mm, 75);
    const double mm2 = field_.mm2_per_px2(blob.centroid_px, 75);
    blob.area_px = static_cast<int>(size_mm.area() / mm2);
    blob.moment_xx_px2 = size_mm.width * size_mm.width / 12 / mm2;
    blob.moment_yy_px2 = size_mm.height * size_mm.height / 12 / mm2;
    blobs_.push_back(blob);
  }
  Detections track(std::string_view yaml = "") {
    Detections out;
    testing::make<Tracker>("three_tag", yaml)->track({0, Timestamp(0), blobs_, field_}, out);
    return out;
  }

  Field field_{[] {
                 FieldParameters parameters;
                 parameters.length_mm = 1600;
                 parameters.width_mm = 1200;
                 return parameters;
               }(),
               {640, 480}};
  std::vector<Blob> blobs_;
};

TEST_F(ThreeTagTest, KeepsTheTrackersContract) {
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "three_tag"),
              ::testing::IsEmpty());
}

TEST_F(ThreeTagTest, ReadsColorsLeftToRightWithTheTeamHalfOnTop) {
  add("yellow", {100, 67.5}, {70, 35});
  add("green", {82.5, 32.5}, {33, 33});
  add("magenta", {117.5, 32.5}, {33, 33});
  const Detections out = track();
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].team, Team::kYellow);
  EXPECT_EQ(out.robots[0].id, 4);
  EXPECT_NEAR(out.robots[0].heading_rad, -CV_PI / 2, 1e-3);
  EXPECT_NEAR(out.robots[0].position_mm.x, 100, 0.1);
  EXPECT_NEAR(out.robots[0].position_mm.y, 50, 0.1);
}

TEST_F(ThreeTagTest, TheIdTableIsData) {
  add("yellow", {100, 67.5}, {70, 35});
  add("green", {82.5, 32.5}, {33, 33});
  add("magenta", {117.5, 32.5}, {33, 33});
  EXPECT_EQ(track("ids: [{id: 42, colors: [green, magenta]}]").robots.at(0).id, 42);
  EXPECT_EQ(track("ids: [{id: 42, colors: [magenta, green]}]").robots.at(0).id, kUnknownId);
}

TEST_F(ThreeTagTest, SquaresThatCannotFitAreAMistake) {
  EXPECT_THROW(testing::make<Tracker>("three_tag", "square_size_mm: 50"), ConfigError);
}

}  // namespace
}  // namespace maggic
