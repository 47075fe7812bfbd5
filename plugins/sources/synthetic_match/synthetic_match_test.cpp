#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "maggic/config_error.hpp"
#include "maggic/field.hpp"
#include "maggic/source.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

StagePtr<Source> match(std::string_view yaml) {
  StagePtr<Source> source = testing::make<Source>("synthetic_match", yaml);
  source->open();
  return source;
}

Frame frame_at(Source& source, int number) {
  Frame frame;
  for (int i = 0; i <= number; ++i) source.read(frame);
  return frame;
}

bool same_picture(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

double distance(cv::Point2d a, cv::Point2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

FieldParameters field_of(const FieldParameters& base, cv::Size picture, double margin_px) {
  FieldParameters field = base;
  field.corners_px = fitted_corners_px(field, picture, margin_px);
  return field;
}

TEST(SyntheticMatch, KeepsTheContractOfSources) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSource, "synthetic_match",
                                         "{width: 65, height: 49, margin_px: 4, frames: 20}"),
              IsEmpty());
}

TEST(SyntheticMatch, SameSeedGivesSameFrames) {
  const std::string_view yaml = "{width: 160, height: 120, seed: 7}";
  const Frame first = frame_at(*match(yaml), 30);
  const Frame second = frame_at(*match(yaml), 30);
  EXPECT_TRUE(same_picture(first.bgr, second.bgr));
  EXPECT_EQ(first.truth.robots[2].position_mm, second.truth.robots[2].position_mm);
}

TEST(SyntheticMatch, SkippedFramesArePlayedAllTheSame) {
  const Frame late = frame_at(*match("{width: 160, height: 120}"), 25);
  const auto source = match("{width: 160, height: 120, skip: 20, frames: 6}");
  Frame frame;
  for (int i = 0; i <= 5; ++i) ASSERT_EQ(source->read(frame), ReadStatus::kFrame);
  EXPECT_TRUE(same_picture(frame.bgr, late.bgr));
  EXPECT_EQ(frame.captured, late.captured);
  EXPECT_EQ(source->read(frame), ReadStatus::kEnd);
}

TEST(SyntheticMatch, AnotherSeedGivesAnotherMatch) {
  const Frame first = frame_at(*match("{width: 160, height: 120, seed: 7}"), 5);
  const Frame second = frame_at(*match("{width: 160, height: 120, seed: 8}"), 5);
  EXPECT_FALSE(same_picture(first.bgr, second.bgr));
  EXPECT_NE(first.truth.robots[2].position_mm, second.truth.robots[2].position_mm);
}

TEST(SyntheticMatch, MovingObjectsLeaveNoTraces) {
  // Only what moved is redrawn, so a place that is empty at two moments must look the same.
  const auto source = match("{width: 320, height: 240, noise: 0, shot_noise: 0}");
  Frame frame;
  source->read(frame);
  Frame start = frame;
  start.bgr = frame.bgr.clone();
  for (int i = 0; i < 400; ++i) source->read(frame);
  const auto covered = [](const Frame& f, cv::Point p) {
    for (const RobotDetection& robot : f.truth.robots) {
      if (distance(robot.centroid_px, p) < 18.0) return true;
    }
    return distance(f.truth.ball->centroid_px, p) < 9.0;
  };
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (covered(start, {x, y}) || covered(frame, {x, y})) continue;
      ASSERT_EQ(start.bgr.at<cv::Vec3b>(y, x), frame.bgr.at<cv::Vec3b>(y, x)) << x << ", " << y;
    }
  }
}

TEST(SyntheticMatch, CapturesAtFrameNumberOverFps) {
  const auto source = match("{width: 64, height: 48, margin_px: 4, fps: 30}");
  Frame frame;
  for (int i = 0; i < 4; ++i) source->read(frame);
  EXPECT_EQ(frame.captured, std::chrono::milliseconds(100));
  EXPECT_EQ(frame.truth.captured, frame.captured);
  EXPECT_TRUE(frame.has_truth);
}

TEST(SyntheticMatch, EndsAfterTheFramesAskedFor) {
  auto source =
      testing::make<Source>("synthetic_match", "{width: 64, height: 48, margin_px: 4, frames: 2}");
  const SourceInfo info = source->open();
  EXPECT_FALSE(info.live);
  EXPECT_EQ(info.frame_count, 2u);
  EXPECT_EQ(info.frames_per_second, 60.0);
  Frame frame;
  EXPECT_EQ(source->read(frame), ReadStatus::kFrame);
  EXPECT_EQ(source->read(frame), ReadStatus::kFrame);
  EXPECT_EQ(source->read(frame), ReadStatus::kEnd);
  EXPECT_EQ(source->read(frame), ReadStatus::kEnd);
}

TEST(SyntheticMatch, IsEndlessByDefault) {
  EXPECT_EQ(testing::make<Source>("synthetic_match")->open().frame_count, std::nullopt);
}

TEST(SyntheticMatch, ListsRobotsInTheOrderOfDetections) {
  const Frame frame = frame_at(
      *match("{width: 64, height: 48, margin_px: 4, format: 5v5, layout: mixed}"), 0);
  std::vector<std::pair<int, int>> keys;
  std::set<std::size_t> patches;
  for (const RobotDetection& robot : frame.truth.robots) {
    keys.emplace_back(static_cast<int>(robot.team), robot.id);
    patches.insert(robot.tags.size());
    EXPECT_EQ(robot.player_colors.size() + 1, robot.tags.size());
  }
  EXPECT_EQ(keys.size(), 10u);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end()) << "an id occurs twice";
  EXPECT_THAT(patches, ElementsAre(2u, 3u));
}

/// What the match promises of its motion, watched through the truth.
class Motion : public ::testing::TestWithParam<const char*> {};

TEST_P(Motion, NothingOverlapsAndAllStaysOnTheField) {
  const auto source = match(GetParam());
  const bool large = std::string_view(GetParam()).find("5v5") != std::string_view::npos;
  const cv::Point2d half = large ? cv::Point2d(1100, 900) : cv::Point2d(750, 650);
  constexpr double kRobotRadius = 53.03;
  constexpr double kBallRadius = 21.35;
  Frame frame;
  cv::Point2d ball_before;
  double ball_way_mm = 0.0;
  std::vector<double> robot_way_mm(22, 0.0);
  std::vector<cv::Point2d> robots_before;
  for (int i = 0; i < 2000; ++i) {
    source->read(frame);
    const auto& robots = frame.truth.robots;
    const cv::Point2d ball = frame.truth.ball->position_mm;
    ASSERT_LE(std::abs(ball.x), half.x - kBallRadius + 1e-6) << i;
    ASSERT_LE(std::abs(ball.y), half.y - kBallRadius + 1e-6) << i;
    for (std::size_t a = 0; a < robots.size(); ++a) {
      ASSERT_LE(std::abs(robots[a].position_mm.x), half.x - kRobotRadius + 0.1) << i;
      ASSERT_LE(std::abs(robots[a].position_mm.y), half.y - kRobotRadius + 0.1) << i;
      ASSERT_GE(distance(robots[a].position_mm, ball), 37.5 + kBallRadius) << i;
      for (std::size_t b = 0; b < a; ++b) {
        ASSERT_GE(distance(robots[a].position_mm, robots[b].position_mm), 2.0 * kRobotRadius) << i;
      }
      if (i > 0) robot_way_mm[a] += distance(robots[a].position_mm, robots_before[a]);
    }
    if (i > 0) ball_way_mm += distance(ball, ball_before);
    ball_before = ball;
    robots_before.clear();
    for (const RobotDetection& robot : robots) robots_before.push_back(robot.position_mm);
  }
  // It is a match: 33 s in which everyone gets about.
  EXPECT_GT(ball_way_mm, 4000.0);
  for (std::size_t a = 0; a < frame.truth.robots.size(); ++a) EXPECT_GT(robot_way_mm[a], 500.0);
}

INSTANTIATE_TEST_SUITE_P(
    Matches, Motion,
    ::testing::Values("{width: 32, height: 24, margin_px: 2}",
                      "{width: 32, height: 24, margin_px: 2, format: 5v5, layout: three_tag}",
                      "{width: 32, height: 24, margin_px: 2, layout: three_tag, "
                      "robots_per_team: 9}"));

TEST(SyntheticMatch, BallIsNeverHiddenByARobot) {
  const auto source = match("{width: 32, height: 24, margin_px: 2}");
  const cv::Size picture(640, 480);  // the motion does not depend on the picture it is seen in
  const Field field(field_of({}, picture, 19.0), picture);
  Frame frame;
  for (int i = 0; i < 2000; ++i) {
    source->read(frame);
    const cv::Point2d ball_mm = frame.truth.ball->position_mm;
    const cv::Point2d ball = field.to_image_px(ball_mm, field.ball_height_mm());
    const double radius =
        distance(ball, field.to_image_px(ball_mm + cv::Point2d(21.35, 0), field.ball_height_mm()));
    for (const RobotDetection& robot : frame.truth.robots) {
      std::vector<cv::Point2f> top;
      for (const double angle : {45.0, 135.0, 225.0, 315.0}) {
        const double a = robot.heading_rad + angle * CV_PI / 180.0;
        top.push_back(field.to_image_px(
            robot.position_mm + 53.03 * cv::Point2d(std::cos(a), std::sin(a)), 75.0));
      }
      ASSERT_LE(cv::pointPolygonTest(top, ball, true), -radius) << i;
    }
  }
}

TEST(SyntheticMatch, VelocitiesAreThoseOfThePositions) {
  const auto source = match("{width: 32, height: 24, margin_px: 2}");
  std::array<Frame, 3> frames;
  for (Frame& frame : frames) source->read(frame);
  int samples = 0;
  int rough = 0;
  for (int i = 0; i < 600; ++i) {
    for (std::size_t r = 0; r < frames[1].truth.robots.size(); ++r) {
      const auto& before = frames[0].truth.robots[r];
      const auto& now = frames[1].truth.robots[r];
      const auto& after = frames[2].truth.robots[r];
      const cv::Point2d difference = (after.position_mm - before.position_mm) * 30.0;
      const double turn = std::remainder(after.heading_rad - before.heading_rad, 2.0 * CV_PI) * 30.0;
      ++samples;
      rough += distance(difference, now.velocity_mm_s) > 60.0 ||
               std::abs(turn - now.angular_velocity_rad_s) > 0.8;
    }
    std::swap(frames[0], frames[1]);
    std::swap(frames[1], frames[2]);
    source->read(frames[2]);
  }
  // The rest are robots that were stopped by another one.
  EXPECT_LE(rough, samples / 50);
}

TEST(SyntheticMatch, TruthAgreesWithAFieldOfTheSameParameters) {
  const auto source = match(R"(
{width: 320, height: 240, half_time: true, lens: {k1: -0.15, k2: 0.02},
 corners_px: [[40, 22], [290, 15], [301, 228], [25, 220]],
 camera: {height_mm: 1800, position_mm: [50, -30]}})");
  FieldParameters parameters;
  parameters.half_time = true;
  parameters.lens_k1 = -0.15;
  parameters.lens_k2 = 0.02;
  parameters.corners_px = {{40, 22}, {290, 15}, {301, 228}, {25, 220}};
  parameters.camera_height_mm = 1800;
  parameters.camera_position_mm = {50, -30};
  const Field field(parameters, {320, 240});
  const Frame frame = frame_at(*source, 50);
  for (const RobotDetection& robot : frame.truth.robots) {
    EXPECT_LT(distance(field.to_field_mm(robot.centroid_px, 75.0), robot.position_mm), 1e-6);
  }
  const BallDetection& ball = *frame.truth.ball;
  EXPECT_LT(distance(field.to_field_mm(ball.centroid_px, 21.35), ball.position_mm), 0.2);
}

TEST(SyntheticMatch, TagsInThePictureHaveTheCentroidsAndAreasOfTheTruth) {
  // Each colour differs from the robot's dark top in one channel alone, which then is a map of how
  // much of each pixel the tag covers.
  const auto source = match(R"(
{width: 800, height: 600, layout: three_tag, robots_per_team: 1,
 noise: 0, shot_noise: 0, blur_px: 0, gradient: 0,
 colors: {blue: [33, 33, 235], red: [233, 33, 35], green: [33, 233, 35]}})");
  const cv::Size picture(800, 600);
  const Field field(field_of({}, picture, 19.0), picture);
  const std::array<double, 3> top{35.0, 33.0, 33.0};
  const std::array<int, 3> channel_of{0, 2, 1};  // blue on the team patch, then red, green
  Frame frame;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 9; ++k) source->read(frame);
    const RobotDetection& robot = frame.truth.robots[0];
    ASSERT_EQ(robot.tags.size(), 3u);
    const double c = std::cos(robot.heading_rad);
    const double s = std::sin(robot.heading_rad);
    std::array<double, 3> area{};
    std::array<cv::Point2d, 3> sum{};
    const cv::Point middle(cvRound(robot.centroid_px.x), cvRound(robot.centroid_px.y));
    for (int y = middle.y - 30; y <= middle.y + 30; ++y) {
      for (int x = middle.x - 30; x <= middle.x + 30; ++x) {
        if (!cv::Rect({}, picture).contains({x, y})) continue;
        const cv::Point2d offset = field.to_field_mm(cv::Point2d(x, y), 75.0) - robot.position_mm;
        const double inside = std::max(std::abs(c * offset.x + s * offset.y),
                                       std::abs(-s * offset.x + c * offset.y));
        if (inside > 36.4) continue;  // pixels that show the floor too
        for (std::size_t tag = 0; tag < 3; ++tag) {
          const int channel = channel_of[tag];
          const double covered = (frame.bgr.at<cv::Vec3b>(y, x)[channel] -
                                  top[static_cast<std::size_t>(channel)]) / 200.0;
          area[tag] += covered;
          sum[tag] += covered * cv::Point2d(x, y);
        }
      }
    }
    for (std::size_t tag = 0; tag < 3; ++tag) {
      EXPECT_LT(distance(sum[tag] / area[tag], robot.tags[tag].centroid_px), 0.05) << i;
      EXPECT_NEAR(area[tag] / robot.tags[tag].area_px, 1.0, 0.01) << i;
    }
  }
}

TEST(SyntheticMatch, DrawsWhatIsPartlyOrWhollyOutsideThePicture) {
  const auto source = match(R"(
{width: 64, height: 48, lens: {k1: -2.0}, blur_px: 2, chroma_subsampling: true,
 corners_px: [[-200, -100], [190, -50], [180, 160], [-150, 150]]})");
  Frame frame;
  for (int i = 0; i < 200; ++i) ASSERT_EQ(source->read(frame), ReadStatus::kFrame);
  EXPECT_EQ(frame.truth.robots.size(), 6u);
}

TEST(SyntheticMatch, NoiseHasTheStandardDeviationAskedFor) {
  const auto source = match(
      "{width: 160, height: 120, noise: 3, shot_noise: 0, chroma_subsampling: false}");
  const Frame frame = frame_at(*source, 0);
  const auto clean_source = match("{width: 160, height: 120, noise: 0, shot_noise: 0}");
  const Frame clean = frame_at(*clean_source, 0);
  cv::Mat difference;
  cv::subtract(frame.bgr, clean.bgr, difference, cv::noArray(), CV_32F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(mean[1], 0.0, 0.1);
  EXPECT_NEAR(deviation[1], 3.0, 0.15);
}

TEST(SyntheticMatch, ChromaSubsamplingBlursColourButNotBrightness) {
  const std::string base = "{width: 321, height: 241, noise: 0, shot_noise: 0, chroma_subsampling: ";
  const cv::Mat full = frame_at(*match(base + "false}"), 0).bgr;
  const cv::Mat shared = frame_at(*match(base + "true}"), 0).bgr;
  EXPECT_FALSE(same_picture(full, shared));
  cv::Mat luma_full;
  cv::Mat luma_shared;
  cv::cvtColor(full, luma_full, cv::COLOR_BGR2GRAY);
  cv::cvtColor(shared, luma_shared, cv::COLOR_BGR2GRAY);
  // Colours at the edge of what eight bits hold are cut off, so a few pixels may differ.
  EXPECT_LT(cv::countNonZero(cv::abs(luma_full - luma_shared) > 2), 321 * 241 / 100);
}

TEST(SyntheticMatch, TellsWhatIsWrongWithItsParameters) {
  EXPECT_THAT([] { match("{layout: three_tag, robots_per_team: 11}"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("expected at most 10")));
  EXPECT_THAT([] { match("{length_mm: 300, width_mm: 300}"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("do not fit")));
  EXPECT_THAT([] { match("{width: 64, height: 48, margin_px: 24}"); },
              ThrowsMessage<ConfigError>(HasSubstr("leaves nothing")));
  EXPECT_THAT([] { match("{format: 7v7}"); }, ThrowsMessage<ConfigError>(HasSubstr("7v7")));
}

}  // namespace
}  // namespace maggic
