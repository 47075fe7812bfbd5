#pragma once

#include "app/templates/shared.hpp"

namespace maggic::app::templates {

inline constexpr Plugin kTracker = {R"cpp(
/// @NAME@: one sentence on what it finds
///
/// When to use it, and where the idea comes from. As it stands it takes the largest blob of one
/// colour for the ball and knows no robots; see maggic/tracking_engine.hpp for tags.
///
///     tracker:
///       @NAME@:
///         ball_color: orange

#include "maggic/plugin.hpp"

namespace {

class @CLASS@ final : public maggic::Tracker {
 public:
  void describe(maggic::Parameters& p) override {
    if (color_ == maggic::kBackground) color_ = p.palette().find("orange").value_or(color_);
    p.color({"ball_color", "colour of the ball"}, color_);
  }

  void track(const maggic::TrackerInput& input, maggic::Detections& out) override {
    out.clear();
    out.sequence = input.sequence;
    out.captured = input.captured;
    const maggic::Blob* largest = nullptr;
    for (const maggic::Blob& blob : input.blobs) {
      if (blob.label != color_) continue;
      if (largest == nullptr || blob.area_px > largest->area_px) largest = &blob;
    }
    if (largest == nullptr) return;
    maggic::BallDetection& ball = out.ball.emplace();
    ball.centroid_px = largest->centroid_px;
    ball.area_px = largest->area_px;
    ball.position_mm = input.field.to_field_mm(largest->centroid_px, input.field.ball_height_mm());
    ball.confidence = 1.0;
  }

 private:
  maggic::Label color_ = maggic::kBackground;
};

}  // namespace

MAGGIC_PLUGIN(@CLASS@, "the largest blob of one colour is the ball")
)cpp",
                                    R"cpp(
#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace {

TEST(@CLASS@, KeepsTheContractOfATracker) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kTracker, "@NAME@"),
              ::testing::IsEmpty());
}

TEST(@CLASS@, TakesTheLargestBlobForTheBall) {
  const auto tracker = maggic::testing::make<maggic::Tracker>("@NAME@", "ball_color: red");
  const maggic::Field field(maggic::FieldParameters{}, cv::Size(640, 480));
  maggic::Blob small;
  small.label = *maggic::testing::standard_palette().find("red");
  small.area_px = 10;
  maggic::Blob large = small;
  large.area_px = 20;
  large.centroid_px = {319.5, 239.5};  // the middle of the picture and of the field
  const std::vector blobs{small, large, small};

  maggic::Detections out;
  tracker->track({0, maggic::Timestamp(0), blobs, field}, out);
  ASSERT_TRUE(out.ball.has_value());
  EXPECT_EQ(out.ball->area_px, 20);
  EXPECT_NEAR(out.ball->position_mm.x, 0.0, 1e-6);
  EXPECT_NEAR(out.ball->position_mm.y, 0.0, 1e-6);
}

}  // namespace
)cpp"};

}  // namespace maggic::app::templates
