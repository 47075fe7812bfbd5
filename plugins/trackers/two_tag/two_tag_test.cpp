#include "maggic/testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/config_error.hpp"
#include "maggic/tracker.hpp"

namespace maggic {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A robot of half-tags, 35 × 70 mm each, that faces right, on a picture of 1 px = 2.7 mm.
class TwoTagTest : public ::testing::Test {
 protected:
  void add(std::string_view color, cv::Point2d center_mm, double scale = 1.0) {
    Blob blob;
    blob.label = *testing::standard_palette().find(color);
    blob.centroid_px = field_.to_image_px(center_mm, 75);
    const double mm2 = field_.mm2_per_px2(blob.centroid_px, 75);
    blob.area_px = static_cast<int>(scale * scale * 35 * 70 / mm2);
    blob.moment_xx_px2 = scale * scale * 35 * 35 / 12 / mm2;
    blob.moment_yy_px2 = scale * scale * 70 * 70 / 12 / mm2;
    blobs_.push_back(blob);
  }
  Detections track(std::string_view yaml) {
    Detections out;
    testing::make<Tracker>("two_tag", yaml)->track({0, Timestamp(0), blobs_, field_}, out);
    return out;
  }

  // A field of the picture's shape, so that a pixel is square.
  Field field_{[] {
                 FieldParameters parameters;
                 parameters.length_mm = 1600;
                 parameters.width_mm = 1200;
                 return parameters;
               }(),
               {640, 480}};
  std::vector<Blob> blobs_;
};

TEST_F(TwoTagTest, KeepsTheTrackersContract) {
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "two_tag"), IsEmpty());
}

TEST_F(TwoTagTest, FindsARobotWithTheDefaultIds) {
  add("blue", {82.5, 50});
  add("cyan", {117.5, 50});
  const Detections out = track("");
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].team, Team::kBlue);
  EXPECT_EQ(out.robots[0].id, 2);
  EXPECT_NEAR(out.robots[0].position_mm.x, 100, 0.1);
  EXPECT_NEAR(out.robots[0].position_mm.y, 50, 0.1);
  EXPECT_NEAR(out.robots[0].heading_rad, 0, 1e-3);
}

TEST_F(TwoTagTest, IdsFrontAndTeamColorsAreData) {
  add("purple", {82.5, 50});
  add("brown", {117.5, 50});
  const Detections out = track(
      "blue_team_color: purple\n"
      "ids: [{id: 7, colors: brown}]\n"
      "heading_offset_deg: 90\n");
  ASSERT_EQ(out.robots.size(), 1u);
  EXPECT_EQ(out.robots[0].team, Team::kBlue);
  EXPECT_EQ(out.robots[0].id, 7);
  EXPECT_NEAR(out.robots[0].heading_rad, CV_PI / 2, 1e-3);
}

TEST_F(TwoTagTest, SmallerTagsAreFoundWhenTheFileSaysSo) {
  add("blue", {91.25, 50}, 0.5);
  add("cyan", {108.75, 50}, 0.5);
  EXPECT_EQ(track("tag_size_mm: 35").robots.size(), 1u);
}

TEST_F(TwoTagTest, MistakesAreNamed) {
  const auto message_of = [](std::string_view yaml) -> std::string {
    try {
      testing::make<Tracker>("two_tag", yaml);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no mistake found";
  };
  EXPECT_THAT(message_of("ids: [{id: 0, colors: red}, {id: 0, colors: green}]"),
              HasSubstr("id 0 is listed twice"));
  EXPECT_THAT(message_of("ids: [{id: 0, colors: red}, {id: 1, colors: red}]"),
              HasSubstr("same colours (red)"));
  EXPECT_THAT(message_of("ids: [{id: 0, colors: [red, green]}]"), HasSubstr("expected 1"));
  EXPECT_THAT(message_of("yellow_team_color: blue"), HasSubstr("the same colour"));
  EXPECT_THAT(message_of("predict_frames: -1"), HasSubstr("predict_frames"));
}

}  // namespace
}  // namespace maggic
