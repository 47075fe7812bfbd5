#include "maggic/testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/config_error.hpp"
#include "maggic/tracker.hpp"

namespace maggic {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kDiagonalAndTwoTag = R"(
layouts:
  - name: diagonal
    patches:
      - {role: team, center_mm: [-17.5, 17.5], size_mm: [35, 35]}
      - {role: player, center_mm: [17.5, -17.5], size_mm: [35, 35]}
    ids: [{id: 5, colors: green}]
  - preset: two_tag
    ids: [{id: 1, colors: red}]
)";

std::string message_of(std::string_view yaml) {
  try {
    testing::make<Tracker>("tag_layout", yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no mistake found";
}

TEST(TagLayoutTest, KeepsTheTrackersContract) {
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "tag_layout", kDiagonalAndTwoTag),
              ::testing::IsEmpty());
}

TEST(TagLayoutTest, FindsSeveralPatternsInOneFrame) {
  FieldParameters parameters;
  parameters.length_mm = 1600;
  parameters.width_mm = 1200;
  const Field field(parameters, {640, 480});
  std::vector<Blob> blobs;
  const auto add = [&](std::string_view color, cv::Point2d center_mm, cv::Size2d size_mm) {
    Blob& blob = blobs.emplace_back();
    blob.label = *testing::standard_palette().find(color);
    blob.centroid_px = field.to_image_px(center_mm, 75);
    const double mm2 = field.mm2_per_px2(blob.centroid_px, 75);
    blob.area_px = static_cast<int>(size_mm.area() / mm2);
    blob.moment_xx_px2 = size_mm.width * size_mm.width / 12 / mm2;
    blob.moment_yy_px2 = size_mm.height * size_mm.height / 12 / mm2;
  };
  add("blue", {-217.5, 117.5}, {35, 35});
  add("green", {-182.5, 82.5}, {35, 35});
  add("blue", {182.5, 0}, {35, 70});
  add("red", {217.5, 0}, {35, 70});
  Detections out;
  testing::make<Tracker>("tag_layout", kDiagonalAndTwoTag)
      ->track({0, Timestamp(0), blobs, field}, out);
  ASSERT_EQ(out.robots.size(), 2u);
  EXPECT_EQ(out.robots[0].id, 1);
  EXPECT_NEAR(out.robots[0].position_mm.x, 200, 0.1);
  EXPECT_EQ(out.robots[1].id, 5);
  EXPECT_NEAR(out.robots[1].position_mm.x, -200, 0.1);
  EXPECT_NEAR(out.robots[1].position_mm.y, 100, 0.1);
  EXPECT_NEAR(out.robots[1].heading_rad, 0, 1e-3);
}

TEST(TagLayoutTest, MistakesInPatternsAreNamed) {
  EXPECT_THAT(message_of("layouts: [{ids: [{id: 0, colors: red}]}]"), HasSubstr("patches"));
  EXPECT_THAT(message_of(R"(
layouts:
  - patches:
      - {role: player, center_mm: [-17.5, 0], size_mm: [35, 70]}
      - {role: player, center_mm: [17.5, 0], size_mm: [35, 70]}
    ids: [{id: 0, colors: red}]
)"),
              HasSubstr("0 patches have the role team"));
  EXPECT_THAT(message_of(R"(
layouts:
  - patches:
      - {role: team, center_mm: [0, 0], size_mm: [35, 70]}
      - {role: player, center_mm: [2, 0], size_mm: [35, 70]}
    ids: [{id: 0, colors: red}]
)"),
              HasSubstr("2.0 mm apart"));
  EXPECT_THAT(message_of(R"(
layouts:
  - patches:
      - {role: team, shape: disc, center_mm: [-18, 0], size_mm: [35, 30]}
      - {role: player, center_mm: [18, 0], size_mm: [35, 70]}
    ids: [{id: 0, colors: red}]
)"),
              HasSubstr("expected its diameter twice"));
  EXPECT_THAT(message_of("layouts: [{preset: two_tag, ids: [{id: 0, colors: [red, red]}]}]"),
              HasSubstr("expected 1"));
  EXPECT_THAT(message_of("layouts: [{preset: four_tag}]"), HasSubstr("four_tag"));
  EXPECT_THAT(message_of("layouts: []"), HasSubstr("layouts"));
}

}  // namespace
}  // namespace maggic
