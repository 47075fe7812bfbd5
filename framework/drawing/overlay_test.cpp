#include "maggic/overlay.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace maggic {
namespace {

const cv::Size kFrameSize(320, 240);
const cv::Scalar kGrass(40, 90, 40);

class OverlayTest : public ::testing::Test {
 protected:
  OverlayTest() { result_.frame.bgr = cv::Mat(kFrameSize, CV_8UC3, kGrass); }

  static OverlayOptions bare() {
    OverlayOptions options;
    options.scale = 1;
    options.field_lines = false;
    options.caption = false;
    return options;
  }

  cv::Mat drawn(OverlayOptions options) {
    Overlay overlay(palette_, options);
    cv::Mat out;
    overlay.draw(result_, field_, out);
    return out;
  }

  /// How many pixels of `out` differ from the empty field within `area`.
  static int touched(const cv::Mat& out, cv::Rect area) {
    cv::Mat same;
    cv::inRange(out(area), kGrass, kGrass, same);
    return area.area() - cv::countNonZero(same);
  }
  static cv::Rect around(cv::Point2d center, int radius) {
    return {cvRound(center.x) - radius, cvRound(center.y) - radius, 2 * radius + 1, 2 * radius + 1};
  }

  RobotDetection robot_at(cv::Point2d centroid_px) const {
    RobotDetection robot;
    robot.centroid_px = centroid_px;
    robot.position_mm = field_.to_field_mm(centroid_px, field_.robot_height_mm());
    return robot;
  }

  const Palette palette_ = Palette::standard();
  const Field field_{FieldParameters{}, kFrameSize};
  FrameResult result_;
};

TEST_F(OverlayTest, EnlargesSmallPicturesTwiceAndKeepsSizesEven) {
  OverlayOptions options;
  options.caption = false;
  EXPECT_EQ(Overlay(palette_, options).size_for({640, 480}), cv::Size(1280, 960));
  EXPECT_EQ(Overlay(palette_, options).size_for({1281, 721}), cv::Size(1282, 722));
  options.scale = 3;
  EXPECT_EQ(Overlay(palette_, options).size_for({101, 33}), cv::Size(304, 100));
}

TEST_F(OverlayTest, LeavesTheFrameAloneAndFillsThePromisedSize) {
  result_.detections.robots.push_back(robot_at({100, 100}));
  const cv::Mat before = result_.frame.bgr.clone();
  const OverlayOptions options;
  const cv::Mat out = drawn(options);
  EXPECT_EQ(out.size(), Overlay(palette_, options).size_for(kFrameSize));
  EXPECT_EQ(cv::norm(before, result_.frame.bgr), 0.0);
}

TEST_F(OverlayTest, AnEmptyFrameWithNothingAskedForIsThePictureItself) {
  EXPECT_EQ(cv::norm(drawn(bare()), result_.frame.bgr), 0.0);
}

TEST_F(OverlayTest, OutlinesTagsInTheirPaletteColor) {
  RobotDetection robot = robot_at({100, 100});
  const Label magenta = *palette_.find("magenta");
  robot.tags.push_back({magenta, {100, 100}, 144.0});
  result_.detections.robots.push_back(robot);
  Blob blob;
  blob.label = magenta;
  blob.area_px = 144;
  blob.centroid_px = {100, 100};
  blob.moment_xx_px2 = blob.moment_yy_px2 = 12.0;  // a box of 12 × 12
  result_.blobs.push_back(blob);
  const cv::Mat out = drawn(bare());
  const DisplayColor c = palette_.display_color(magenta);
  const cv::Vec3b edge = out.at<cv::Vec3b>(106, 96);
  EXPECT_NEAR(edge[0], c.blue, 40);
  EXPECT_NEAR(edge[1], c.green, 40);
  EXPECT_NEAR(edge[2], c.red, 40);
}

TEST_F(OverlayTest, PointsTheArrowToTheFront) {
  RobotDetection robot = robot_at({160, 120});
  robot.heading_rad = -CV_PI / 2;  // down in the picture
  result_.detections.robots.push_back(robot);
  const cv::Mat out = drawn(bare());
  EXPECT_GT(touched(out, around({160, 128}, 3)), 0);
  EXPECT_EQ(touched(out, around({148, 120}, 3)), 0);
  EXPECT_EQ(touched(out, around({160, 108}, 3)), 0);
}

TEST_F(OverlayTest, PredictedRobotsAreCircledAndSeenOnesAreNot) {
  RobotDetection robot = robot_at({160, 120});
  result_.detections.robots.push_back(robot);
  const int seen = touched(drawn(bare()), around({160, 120}, 20));
  result_.detections.robots[0].state = TrackState::kPredicted;
  EXPECT_GT(touched(drawn(bare()), around({160, 120}, 20)), seen);
}

TEST_F(OverlayTest, DrawsTheTrailOfTheBallUntilItIsLost) {
  Overlay overlay(palette_, bare());
  cv::Mat out;
  const auto frame_with_ball_at = [&](std::optional<double> x) {
    result_.detections.ball.reset();
    if (x) {
      result_.detections.ball = BallDetection{};
      result_.detections.ball->centroid_px = {*x, 120.0};
    }
    overlay.draw(result_, field_, out);
  };
  frame_with_ball_at(60);
  frame_with_ball_at(160);
  EXPECT_GT(touched(out, around({100, 120}, 3)), 0) << "between the two places";
  frame_with_ball_at(std::nullopt);
  frame_with_ball_at(160);
  EXPECT_EQ(touched(out, around({100, 120}, 3)), 0);
}

TEST_F(OverlayTest, SurvivesDetectionsFarOutsideThePicture) {
  result_.detections.robots.push_back(robot_at({-1e7, 1e9}));
  result_.detections.ball = BallDetection{};
  result_.detections.ball->centroid_px = {1e8, -1e8};
  EXPECT_EQ(drawn(OverlayOptions()).type(), CV_8UC3);
}

TEST_F(OverlayTest, DrawsOnPicturesOfAnySize) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 1), cv::Size(17, 5)}) {
    result_.frame.bgr = cv::Mat(size, CV_8UC3, kGrass);
    cv::Mat out;
    Overlay overlay(palette_);
    overlay.draw(result_, Field(FieldParameters{}, size), out);
    EXPECT_EQ(out.size(), overlay.size_for(size));
  }
}

}  // namespace
}  // namespace maggic
