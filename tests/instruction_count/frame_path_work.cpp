/// Sends made-up frames through a pipeline and lets callgrind count the instructions that takes.
///   frame_path_work PIPELINE_FILE
/// Prints the vector instruction set it ran with. Exits with 1 when the frames do not show the
/// pipeline what they are meant to: six robots and a ball.

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <valgrind/callgrind.h>
#include <opencv2/imgproc.hpp>

#include "maggic/pipeline_builder.hpp"
#include "maggic/simd_target.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

constexpr int kWarmUpFrames = 20;
constexpr int kFrames = 20;
constexpr std::size_t kRobots = 6;
const cv::Size kFrameSize{640, 480};
constexpr std::chrono::nanoseconds kPeriod{16'666'667};

const cv::Scalar kFloor(28, 26, 27);
const cv::Scalar kLine(220, 220, 220);
const cv::Scalar kBlue(205, 78, 38);
const cv::Scalar kYellow(52, 208, 228);
const cv::Scalar kOrange(30, 96, 238);
const std::array kPlayers{cv::Scalar(42, 28, 212), cv::Scalar(88, 172, 44),
                          cv::Scalar(148, 58, 214)};

/// Whole pixels and whole numbers only, so that every machine draws the same.
void draw_robot(cv::Mat& frame, cv::Point center, bool upright, const cv::Scalar& team,
                const cv::Scalar& player) {
  constexpr int kSide = 26;
  const cv::Size half = upright ? cv::Size(kSide, kSide / 2) : cv::Size(kSide / 2, kSide);
  const cv::Point corner = center - cv::Point(kSide / 2, kSide / 2);
  const cv::Point next = upright ? cv::Point(0, kSide / 2) : cv::Point(kSide / 2, 0);
  cv::rectangle(frame, cv::Rect(corner, half), team, cv::FILLED);
  cv::rectangle(frame, cv::Rect(corner + next, half), player, cv::FILLED);
}

/// Two teams of three and a ball that move by a pixel or two a frame, on a dark field with its
/// lines, under sensor noise.
cv::Mat draw_frame(int number, cv::RNG& noise_source) {
  cv::Mat frame(kFrameSize, CV_8UC3, kFloor);
  cv::rectangle(frame, cv::Rect(64, 18, 511, 443), kLine, 2);
  cv::line(frame, {319, 18}, {319, 460}, kLine, 2);
  for (int robot = 0; robot < static_cast<int>(kRobots); ++robot) {
    const cv::Point center(110 + 80 * robot, 100 + 45 * robot + (robot % 2 ? number : -number));
    const auto player = static_cast<std::size_t>(robot / 2);
    draw_robot(frame, center, robot % 3 == 0, robot % 2 ? kYellow : kBlue, kPlayers.at(player));
  }
  cv::circle(frame, {150 + 2 * number, 380}, 7, kOrange, cv::FILLED);
  cv::Mat noise(kFrameSize, CV_16SC3);
  noise_source.fill(noise, cv::RNG::UNIFORM, -6, 7);
  cv::add(frame, noise, frame, cv::noArray(), CV_8UC3);
  return frame;
}

void expect_everything_seen(const Detections& detections) {
  std::size_t seen = 0;
  for (const RobotDetection& robot : detections.robots) seen += robot.state == TrackState::kSeen;
  if (seen == kRobots && detections.ball) return;
  throw std::runtime_error(fmt::format(
      "found {} robots and {} ball in the last frame, expected {} and a ball: the count "
      "would say little",
      seen, detections.ball ? "a" : "no", kRobots));
}

void work(const char* pipeline_file) {
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = pipeline_file;
  Pipeline pipeline(build_parts(request, testing::registry(), reporter), reporter);
  cv::RNG noise_source(1);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < kWarmUpFrames + kFrames; ++i) frames.push_back(draw_frame(i, noise_source));

  FrameResult result;
  for (int i = 0; i < kWarmUpFrames + kFrames; ++i) {
    result.frame.sequence = static_cast<std::uint64_t>(i);
    result.frame.captured = kPeriod * i;
    result.frame.bgr = frames[static_cast<std::size_t>(i)];
    if (i == kWarmUpFrames) CALLGRIND_START_INSTRUMENTATION;
    pipeline.process(result);
  }
  CALLGRIND_STOP_INSTRUMENTATION;
  expect_everything_seen(result.detections);
}

}  // namespace
}  // namespace maggic

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: frame_path_work PIPELINE_FILE\n");
    return 2;
  }
  try {
    maggic::work(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "frame_path_work: {}\n", error.what());
    return 1;
  }
  fmt::print("{}\n", maggic::simd_target());
  return 0;
}
