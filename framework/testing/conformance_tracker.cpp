#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <thread>
#include <tuple>

#include "blob_scene.hpp"
#include "conformance.hpp"

namespace maggic::testing {
namespace {

using Place = std::tuple<Label, double, double>;

Place place_of(const TagSighting& tag) { return {tag.label, tag.centroid_px.x, tag.centroid_px.y}; }

bool is_finite(cv::Point2d p) { return std::isfinite(p.x) && std::isfinite(p.y); }

void check_confidence(std::string_view what, double confidence, Findings& findings) {
  if (!(confidence > 0.0 && confidence <= 1.0)) {
    findings.add("a {} has a confidence outside (0, 1]", what);
  }
}

void check_robot(const RobotDetection& robot, Findings& findings) {
  if (!is_finite(robot.position_mm) || !is_finite(robot.velocity_mm_s) ||
      !is_finite(robot.centroid_px) || !std::isfinite(robot.heading_rad) ||
      !std::isfinite(robot.angular_velocity_rad_s)) {
    findings.add("a robot has a number that is not finite");
  } else if (robot.heading_rad <= -std::numbers::pi || robot.heading_rad > std::numbers::pi) {
    findings.add("a heading is outside (-pi, pi]");
  }
  check_confidence("robot", robot.confidence, findings);
  if (robot.id < kUnknownId) findings.add("a robot has the id {}, expected -1 or more", robot.id);
  if (robot.state == TrackState::kPredicted && !robot.tags.empty()) {
    findings.add("a predicted robot has tags, expected none");
  }
}

void check_ball(const BallDetection& ball, Findings& findings) {
  if (!is_finite(ball.position_mm) || !is_finite(ball.velocity_mm_s) ||
      !is_finite(ball.centroid_px) || !std::isfinite(ball.area_px)) {
    findings.add("a ball has a number that is not finite");
  }
  check_confidence("ball", ball.confidence, findings);
}

/// Blue before yellow, ids ascending, unknown ids last.
bool in_order(const RobotDetection& a, const RobotDetection& b) {
  const auto rank = [](const RobotDetection& r) {
    return std::tuple(r.team, r.id == kUnknownId, r.id);
  };
  return rank(a) < rank(b) || rank(a) == rank(b);
}

void check_robots(const Detections& out, std::span<const Blob> blobs, Findings& findings) {
  std::set<Place> free;
  for (const Blob& blob : blobs) {
    free.insert({blob.label, blob.centroid_px.x, blob.centroid_px.y});
  }
  const std::set<Place> all = free;
  std::set<std::tuple<Team, int>> ids;
  for (const RobotDetection& robot : out.robots) {
    check_robot(robot, findings);
    if (robot.id != kUnknownId && !ids.insert({robot.team, robot.id}).second) {
      findings.add("id {} occurs more than once in team {}", robot.id, name_of(robot.team));
    }
    for (const TagSighting& tag : robot.tags) {
      if (!all.contains(place_of(tag))) {
        findings.add("a robot has a tag that is no blob of the frame");
      } else if (free.erase(place_of(tag)) == 0) {
        findings.add("one blob belongs to two objects");
      }
    }
  }
  for (std::size_t i = 1; i < out.robots.size(); ++i) {
    if (!in_order(out.robots[i - 1], out.robots[i])) {
      findings.add("the robots are not in order: blue before yellow, ids ascending, unknown last");
    }
  }
}

bool same_place(cv::Point2d a, cv::Point2d b) { return a.x == b.x && a.y == b.y; }

bool same_robot(const RobotDetection& a, const RobotDetection& b) {
  return a.team == b.team && a.id == b.id && a.player_colors == b.player_colors &&
         same_place(a.position_mm, b.position_mm) && a.heading_rad == b.heading_rad &&
         same_place(a.velocity_mm_s, b.velocity_mm_s) && a.state == b.state &&
         a.angular_velocity_rad_s == b.angular_velocity_rad_s &&
         same_place(a.centroid_px, b.centroid_px) && a.confidence == b.confidence &&
         std::ranges::equal(a.tags, b.tags, {}, place_of, place_of);
}

bool same(const Detections& a, const Detections& b) {
  if (a.ball.has_value() != b.ball.has_value()) return false;
  if (a.ball && !(same_place(a.ball->position_mm, b.ball->position_mm) &&
                  same_place(a.ball->velocity_mm_s, b.ball->velocity_mm_s) &&
                  a.ball->confidence == b.ball->confidence && a.ball->state == b.ball->state)) {
    return false;
  }
  return std::ranges::equal(a.robots, b.robots, same_robot);
}

/// What an earlier frame may have left in `out`.
Detections left_over() {
  Detections old;
  old.sequence = 999'999;
  old.ball = BallDetection{};
  old.robots.resize(3);
  return old;
}

std::vector<Detections> track_all(Tracker& tracker, const std::vector<BlobFrame>& frames,
                                  bool reuse_output) {
  const Field field(FieldParameters{}, BlobFrame::kSize);
  std::vector<Detections> result;
  Detections out = left_over();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!reuse_output) out = left_over();
    tracker.track({i, frames[i].captured, frames[i].blobs, field}, out);
    result.push_back(out);
  }
  return result;
}

}  // namespace

void check_tracker(const Maker<Tracker>& make, Findings& findings) {
  const StagePtr<Tracker> first = make();
  const StagePtr<Tracker> second = make();
  const std::vector<BlobFrame> frames = blob_scene(standard_palette());
  std::vector<Detections> here;
  std::vector<Detections> there;
  Findings unused;  // the other instance breaks the same promises
  std::thread other([&] { runs(unused, "", [&] { there = track_all(*second, frames, false); }); });
  runs(findings, "a frame", [&] { here = track_all(*first, frames, true); });
  other.join();
  if (here.size() != there.size()) findings.add("of two instances on two threads one failed");

  for (std::size_t i = 0; i < here.size(); ++i) {
    const Detections& out = here[i];
    if (out.sequence != i || out.captured != frames[i].captured) {
      findings.add("sequence and capture time of the input were not passed on");
    }
    check_robots(out, frames[i].blobs, findings);
    if (out.ball) check_ball(*out.ball, findings);
    if (i < there.size() && !same(out, there[i])) {
      findings.add("two instances on two threads disagree, or what `out` held before shows");
    }
  }
}

}  // namespace maggic::testing
