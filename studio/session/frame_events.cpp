#include "studio/session/frame_events.hpp"

#include <string>

namespace maggic::studio {
namespace {

constexpr std::chrono::milliseconds kBetweenEvents{100};

double in_ms(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

nlohmann::json quantiles(const DurationHistogram& times) {
  return {{"p50", in_ms(times.quantile(0.5))}, {"p99", in_ms(times.quantile(0.99))}};
}

}  // namespace

void FrameEvents::add(const FrameResult& result, std::uint64_t processed, std::uint64_t dropped) {
  times_.add(result.times);
  for (const RobotDetection& robot : result.detections.robots) {
    if (robot.state == TrackState::kSeen) {
      last_seen_[{robot.team, robot.id}] = result.frame.sequence;
    }
  }
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> since_last = now - last_event_;
  if (since_last < kBetweenEvents) return;

  const bool is_first = last_event_ == Clock::time_point{};
  const auto frames = static_cast<double>(processed - processed_at_last_);
  const nlohmann::json event{
      {"frame", result.frame.sequence},
      {"t_capture", std::chrono::duration<double>(result.frame.captured).count()},
      {"fps", is_first ? 0.0 : frames / since_last.count()},
      {"processed", processed},
      {"dropped", dropped},
      {"ms", times()},
      {"ball", ball(result.detections)},
      {"robots", robots(result.detections)}};
  log_.add("frame", event.dump());
  last_event_ = now;
  processed_at_last_ = processed;
  times_ = {};
}

nlohmann::json FrameEvents::times() const {
  return {{"segment", quantiles(times_.of(Step::kSegment))},
          {"blobs", quantiles(times_.of(Step::kBlobs))},
          {"track", quantiles(times_.of(Step::kTrack))},
          {"total", quantiles(times_.frame_path())}};
}

nlohmann::json FrameEvents::ball(const Detections& detections) {
  if (!detections.ball) return nullptr;
  const BallDetection& ball = *detections.ball;
  return {{"x_mm", ball.position_mm.x},    {"y_mm", ball.position_mm.y},
          {"x_px", ball.centroid_px.x},    {"y_px", ball.centroid_px.y},
          {"confidence", ball.confidence}, {"state", name_of(ball.state)}};
}

nlohmann::json FrameEvents::robots(const Detections& detections) {
  nlohmann::json robots = nlohmann::json::array();
  for (const RobotDetection& robot : detections.robots) {
    const std::uint64_t last_seen = last_seen_[{robot.team, robot.id}];
    nlohmann::json told{
        {"team", name_of(robot.team)},      {"id", nullptr},
        {"x_mm", robot.position_mm.x},      {"y_mm", robot.position_mm.y},
        {"heading_rad", robot.heading_rad}, {"x_px", robot.centroid_px.x},
        {"y_px", robot.centroid_px.y},      {"confidence", robot.confidence},
        {"state", name_of(robot.state)},    {"age_frames", detections.sequence - last_seen}};
    if (robot.id != kUnknownId) told["id"] = robot.id;
    robots.push_back(std::move(told));
  }
  return robots;
}

}  // namespace maggic::studio
