#include "calibration/strays.hpp"

#include <set>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/tags_for_tests.hpp"

namespace maggic::calibration {
namespace {

using tags::label;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const cv::Scalar kBlueColor{255, 0, 0};
const cv::Scalar kYellowColor{0, 255, 255};
const cv::Scalar kBallColor{255, 0, 255};

/// A label for each pure colour. Asked for pictures, so that no table is compiled.
struct PureSegmenter : ImageSegmenter {
  const Label blue = label("blue");
  const Label yellow = label("yellow");
  const Label ball = label("orange");
  void segment(const cv::Mat& bgr, const cv::Mat&, cv::Mat& labels) override {
    labels.setTo(kBackground);
    const auto paint = [&](const cv::Scalar& color, Label name) {
      cv::Mat mask;
      cv::inRange(bgr, color, color, mask);
      labels.setTo(name, mask);
    };
    paint(kBlueColor, blue);
    paint(kYellowColor, yellow);
    paint(kBallColor, ball);
  }
};

/// Says of every frame that one robot is where it is told.
struct OneRobotTracker : Tracker {
  std::optional<cv::Point2d> tag_px;
  Label player = label("red");
  void track(const TrackerInput&, Detections& out) override {
    out.robots.clear();
    out.ball.reset();
    if (!tag_px) return;
    RobotDetection robot;
    robot.id = 0;
    robot.player_colors.push_back(player);
    robot.tags.push_back({.label = label("blue"), .centroid_px = *tag_px, .area_px = 288});
    out.robots.push_back(robot);
  }
};

/// A field of 3 mm a pixel.
class StraysTest : public ::testing::Test {
 protected:
  StraysTest() : picture_(560, 640, CV_8UC3, cv::Scalar(0, 0, 0)) {
    pattern_ = {.layouts = {two_tag_layout(Palette::standard())},
                .blue_team_color = label("blue"),
                .yellow_team_color = label("yellow"),
                .ball_color = label("orange"),
                .ball_diameter_mm = 42.7};
    auto tracker = std::make_unique<OneRobotTracker>();
    tracker_ = tracker.get();
    PipelineParts parts;
    parts.palette = Palette::standard();
    parts.field.corners_px = {{70, 60}, {570, 60}, {570, 493.3}, {70, 493.3}};
    parts.normalizer =
        fakes::named<Normalizer>("same", std::make_unique<fakes::SameImageNormalizer>());
    parts.segmenter = fakes::named<Segmenter>("pure", std::make_unique<PureSegmenter>());
    parts.tracker = fakes::named<Tracker>("one", std::move(tracker));
    pipeline_ = std::make_unique<Pipeline>(std::move(parts), reporter_);
  }

  void draw(cv::Rect where, const cv::Scalar& color) { picture_(where).setTo(color); }
  /// A half-tag: 70 × 35 mm.
  void draw_tag(cv::Point at) { draw({at.x, at.y, 12, 24}, kBlueColor); }
  void draw_ball(cv::Point at) { cv::circle(picture_, at, 7, kBallColor, cv::FILLED); }

  std::vector<Stray> find(const std::optional<Patch>& ball = {}) {
    const std::vector<cv::Mat> frames{picture_};
    BallSightings sightings;
    sightings.by_frame = {ball};
    return find_strays(*pipeline_, frames, sightings, pattern_, known_).at(0);
  }

  testing::RecordingReporter reporter_;
  cv::Mat picture_;
  TrackedPattern pattern_;
  const std::set<Identity> known_{{label("blue"), {label("red")}}};
  OneRobotTracker* tracker_ = nullptr;
  std::unique_ptr<Pipeline> pipeline_;
};

TEST_F(StraysTest, ALoneTeamTagIsOne) {
  draw_tag({100, 100});
  const auto strays = find();
  ASSERT_THAT(strays, SizeIs(1));
  EXPECT_EQ(strays[0].centroid_px, cv::Point2d(105.5, 111.5));
  EXPECT_EQ(strays[0].area_px, 12.0 * 24.0);
}

TEST_F(StraysTest, TheTagOfARobotIsNone) {
  draw_tag({100, 100});
  tracker_->tag_px = cv::Point2d(105.5, 111.5);
  EXPECT_THAT(find(), IsEmpty());
}

TEST_F(StraysTest, ARobotNobodyHasSeenIsMadeOfScraps) {
  tracker_->tag_px = cv::Point2d(105.5, 111.5);
  tracker_->player = label("magenta");
  EXPECT_THAT(find(), SizeIs(1));
}

TEST_F(StraysTest, WhatHasNoTagsSizeOrShapeIsNone) {
  draw({100, 100, 6, 6}, kBlueColor);
  draw({200, 100, 50, 50}, kBlueColor);
  draw({300, 100, 60, 5}, kBlueColor);
  EXPECT_THAT(find(), IsEmpty());
}

TEST_F(StraysTest, WhatLiesBeyondTheFieldIsNone) {
  draw_tag({54, 200});
  EXPECT_THAT(find(), SizeIs(1)) << "within 5 cm of the field it still counts";
  picture_.setTo(cv::Scalar(0, 0, 0));
  draw_tag({10, 200});
  draw_tag({300, 530});
  EXPECT_THAT(find(), IsEmpty());
}

TEST_F(StraysTest, ASecondBallIsOneWhereTheBallIsKnown) {
  draw_ball({200, 200});
  draw_ball({400, 300});
  EXPECT_THAT(find(), IsEmpty()) << "no ball was seen, so which is it?";
  const auto strays = find(tags::patch_at({200, 200}, 160.0, 20.0));
  ASSERT_THAT(strays, SizeIs(1));
  EXPECT_LT(cv::norm(strays[0].centroid_px - cv::Point2d(400, 300)), 0.5);
}

TEST_F(StraysTest, EmptyFramesHaveNone) {
  EXPECT_THAT(find(), IsEmpty());
  const std::vector<cv::Mat> broken(1);
  BallSightings none;
  none.by_frame.resize(1);
  EXPECT_THAT(find_strays(*pipeline_, broken, none, pattern_, known_), ElementsAre(IsEmpty()));
}

}  // namespace
}  // namespace maggic::calibration
