#include "conformance.hpp"

namespace maggic::testing {
namespace {

const cv::Size kSize{64, 48};

FrameResult result_of(std::uint64_t sequence, cv::Size size) {
  FrameResult result;
  result.frame.sequence = sequence;
  result.frame.captured = std::chrono::milliseconds(16 * sequence);
  result.frame.bgr = cv::Mat(size, CV_8UC3, cv::Scalar(40, 80, 120));
  result.detections.sequence = sequence;
  result.detections.captured = result.frame.captured;
  return result;
}

/// A ball, a robot seen and one predicted, the way trackers report them.
void add_detections(FrameResult& result) {
  result.detections.ball = BallDetection{};
  result.detections.ball->centroid_px = {10.5, 20.25};
  result.detections.ball->confidence = 0.5;
  RobotDetection robot;
  robot.id = 3;
  robot.player_colors = {*standard_palette().find("red"), *standard_palette().find("cyan")};
  robot.centroid_px = {30.0, 25.0};
  robot.confidence = 1.0;
  robot.tags = {{*standard_palette().find("blue"), {28.0, 25.0}, 40.0}};
  result.detections.robots.push_back(robot);
  robot.team = Team::kYellow;
  robot.id = kUnknownId;
  robot.player_colors.clear();
  robot.tags.clear();
  robot.state = TrackState::kPredicted;
  result.detections.robots.push_back(robot);
  result.frame.has_truth = true;
  result.frame.truth = result.detections;
  result.frame.truth_labels = cv::Mat::zeros(result.frame.bgr.size(), CV_8UC1);
  Blob blob;
  blob.label = *standard_palette().find("blue");
  blob.area_px = 4;
  blob.bounds_px = {27, 24, 2, 2};
  result.blobs.push_back(blob);
  result.runs = {{24, 27, 29, blob.label}, {25, 27, 29, blob.label}};
}

}  // namespace

void check_sink(const Maker<Sink>& make, Findings& findings) {
  const RunInfo info{standard_palette(), SourceInfo{false, 5, 60.0}};
  const Field field(FieldParameters{}, kSize);

  make();  // and destroyed without being opened, as `maggic check` does
  runs(findings, "opening and closing without a frame", [&] {
    const StagePtr<Sink> sink = make();
    sink->open(info);
    sink->close();
  });
  runs(findings, "opening and destroying without closing", [&] {
    const StagePtr<Sink> sink = make();
    sink->open(info);
  });

  const StagePtr<Sink> sink = make();
  if (!runs(findings, "opening", [&] { sink->open(info); })) return;
  runs(findings, "writing a frame in which nothing was found",
       [&] { sink->write(result_of(0, kSize), field); });
  runs(findings, "writing robots and ball", [&] {
    FrameResult result = result_of(1, kSize);
    add_detections(result);
    sink->write(result, field);
  });
  runs(findings, "writing after frames were dropped",
       [&] { sink->write(result_of(4, kSize), field); });
  runs(findings, "closing", [&] { sink->close(); });
}

}  // namespace maggic::testing
