#include "maggic/scorecard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "assignment/assignment.hpp"

namespace maggic {
namespace {

constexpr double kHalfRobotMm = 37.5;
constexpr double kGateInTolerances = 3.0;

double length(cv::Point2d v) { return std::hypot(v.x, v.y); }

/// A true object with its place in both units.
struct Place {
  cv::Point2d px;
  cv::Point2d mm;
};

template <class Object>
Place place_of(const Object& object, const Field& field, double height_mm) {
  const cv::Point2d px =
      object.centroid_px ? *object.centroid_px : field.to_image_px(*object.position_mm, height_mm);
  return {px, object.position_mm ? *object.position_mm : field.to_field_mm(px, height_mm)};
}

std::optional<double> heading_of(const TrueRobot& robot, cv::Point2d px, const Field& field) {
  if (robot.heading_rad || !robot.picture_heading_rad) return robot.heading_rad;
  // A direction in the picture is none of the field where the picture is stretched or tilted.
  const double angle = *robot.picture_heading_rad;
  const cv::Vec2d along = field.jacobian_mm_per_px(px, field.robot_height_mm()) *
                          cv::Vec2d(std::cos(angle), -std::sin(angle));
  return std::atan2(along[1], along[0]);
}

double degrees_between(double a_rad, double b_rad) {
  const double turn = std::remainder(a_rad - b_rad, 2.0 * std::numbers::pi);
  return std::abs(turn) * 180.0 / std::numbers::pi;
}

/// How far apart objects are in the tolerance's unit, and which are too far to be the same.
class Ruler {
 public:
  Ruler(Tolerance tolerance, const Field& field) : tolerance_(tolerance), field_(field) {}

  template <class Detection>
  double apart(const Detection& found, const Place& truth) const {
    return in_pixels() ? length(found.centroid_px - truth.px)
                       : length(found.position_mm - truth.mm);
  }

  double gate(const Place& truth, double height_mm) const {
    return std::max(kGateInTolerances * tolerance_.distance, half_robot(truth, height_mm));
  }

  bool is_near(double apart) const { return apart <= tolerance_.distance; }

 private:
  bool in_pixels() const { return tolerance_.unit == Tolerance::Unit::kPixels; }

  double half_robot(const Place& truth, double height_mm) const {
    if (!in_pixels()) return kHalfRobotMm;
    const double mm2_per_px2 = field_.mm2_per_px2(truth.px, height_mm);
    return mm2_per_px2 > 0.0 ? kHalfRobotMm / std::sqrt(mm2_per_px2) : 0.0;
  }

  Tolerance tolerance_;
  const Field& field_;
};

enum class IdentityAnswer { kRight, kUnknown, kWrong };

IdentityAnswer compare(const RobotDetection& found, const TrueIdentity& truth) {
  if (found.team != truth.team) return IdentityAnswer::kWrong;
  if (truth.id) {
    if (found.id == *truth.id) return IdentityAnswer::kRight;
    return found.id == kUnknownId ? IdentityAnswer::kUnknown : IdentityAnswer::kWrong;
  }
  if (truth.player_colors.empty() || found.player_colors == truth.player_colors) {
    return IdentityAnswer::kRight;
  }
  return found.player_colors.empty() ? IdentityAnswer::kUnknown : IdentityAnswer::kWrong;
}

bool bears(const RobotDetection& found, const TrueIdentity& identity) {
  return compare(found, identity) == IdentityAnswer::kRight;
}

/// A found and a true robot, by index, that may be the same.
struct Link {
  std::size_t found = 0;
  std::size_t truth = 0;
  double apart = 0.0;
  double gate = 0.0;
};

/// Of the links those that use every robot once: as many as possible, and of those the nearest in
/// total.
std::vector<Link> best_of(const std::vector<Link>& links, std::size_t true_robots) {
  double widest = 0.0;
  for (const Link& link : links) widest = std::max(widest, link.gate);
  // One link more outweighs any distances the others can lose by it.
  const double one_more = widest * static_cast<double>(true_robots + 1);
  std::vector<Contender> contenders;
  contenders.reserve(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    contenders.push_back({.score = one_more + widest - links[i].apart + 1e-9,
                          .group = static_cast<int>(links[i].truth),
                          .place = static_cast<int>(i),
                          .identity = static_cast<int>(links[i].found)});
  }
  AssignmentSolver solver(1'000'000);
  std::vector<int> chosen;
  solver.solve(contenders, {}, chosen);
  std::vector<Link> best;
  best.reserve(chosen.size());
  for (const int i : chosen) best.push_back(links[static_cast<std::size_t>(i)]);
  return best;
}

/// Matches the found robots in `state` with the true ones not `taken` yet, and takes them.
std::vector<Link> match(const Detections& found, TrackState state, std::span<const Place> places,
                        const Ruler& ruler, double height_mm, std::vector<bool>& taken) {
  std::vector<Link> links;
  for (std::size_t t = 0; t < places.size(); ++t) {
    if (taken[t]) continue;
    const double gate = ruler.gate(places[t], height_mm);
    for (std::size_t f = 0; f < found.robots.size(); ++f) {
      if (found.robots[f].state != state) continue;
      const double apart = ruler.apart(found.robots[f], places[t]);
      if (apart <= gate) links.push_back({f, t, apart, gate});
    }
  }
  std::vector<Link> best = best_of(links, places.size());
  for (const Link& link : best) taken[link.truth] = true;
  return best;
}

template <class Detection>
void tally_place(const Detection& found, const Place& truth, ObjectTally& tally) {
  tally.position_px.add(length(found.centroid_px - truth.px));
  tally.position_mm.add(length(found.position_mm - truth.mm));
  tally.jitter_px.add(found.centroid_px, truth.px);
  tally.jitter_mm.add(found.position_mm, truth.mm);
}

}  // namespace

void ObjectTally::merge(const ObjectTally& other) {
  frames += other.frames;
  seen += other.seen;
  predicted += other.predicted;
  within_tolerance += other.within_tolerance;
  right_identity += other.right_identity;
  wrong_identity += other.wrong_identity;
  unknown_identity += other.unknown_identity;
  exchanged += other.exchanged;
  position_px.merge(other.position_px);
  position_mm.merge(other.position_mm);
  heading_deg.merge(other.heading_deg);
  jitter_px.merge(other.jitter_px);
  jitter_mm.merge(other.jitter_mm);
}

/// A robot that was seen, and which of `robots_` it really is.
struct Scorecard::Pair {
  const RobotDetection* found = nullptr;
  std::size_t robot = 0;
};

ObjectTally Scorecard::robots() const {
  ObjectTally all;
  for (const RobotTally& robot : robots_) all.merge(robot.tally);
  return all;
}

std::size_t Scorecard::index_of(const TrueIdentity& identity) {
  const auto known = std::ranges::find(robots_, identity, &RobotTally::identity);
  if (known != robots_.end()) return static_cast<std::size_t>(known - robots_.begin());
  robots_.push_back({identity, {}});
  return robots_.size() - 1;
}

void Scorecard::add(const Detections& found, const TrueScene& truth, const Field& field) {
  ++frames_;
  const bool robots_right = judge_robots(found, truth, field);
  const bool ball_right = judge_ball(found, truth, field);
  if (robots_right && ball_right) ++frames_right_;
}

bool Scorecard::judge_robots(const Detections& found, const TrueScene& truth, const Field& field) {
  const double height_mm = field.robot_height_mm();
  const Ruler ruler(tolerance_, field);
  std::vector<Place> places;
  std::vector<std::size_t> indices;
  for (const TrueRobot& robot : truth.robots) {
    places.push_back(place_of(robot, field, height_mm));
    indices.push_back(index_of(robot.identity));
    ++robots_[indices.back()].tally.frames;
  }
  std::vector<bool> taken(places.size(), false);
  const auto seen = match(found, TrackState::kSeen, places, ruler, height_mm, taken);
  const auto predicted = match(found, TrackState::kPredicted, places, ruler, height_mm, taken);
  for (const Link& link : predicted) ++robots_[indices[link.truth]].tally.predicted;

  bool all_right = seen.size() == truth.robots.size();
  std::vector<Pair> pairs;
  for (const Link& link : seen) {
    const RobotDetection& robot = found.robots[link.found];
    const TrueRobot& real = truth.robots[link.truth];
    const Place& place = places[link.truth];
    ObjectTally& tally = robots_[indices[link.truth]].tally;
    pairs.push_back({&robot, indices[link.truth]});
    ++tally.seen;
    if (ruler.is_near(link.apart)) {
      ++tally.within_tolerance;
    } else {
      all_right = false;
    }
    if (!bears(robot, real.identity)) all_right = false;
    tally_place(robot, place, tally);
    if (const auto heading_rad = heading_of(real, place.px, field)) {
      tally.heading_deg.add(degrees_between(robot.heading_rad, *heading_rad));
    }
  }
  judge_identities(pairs);

  const auto seen_robots = static_cast<std::size_t>(
      std::ranges::count(found.robots, TrackState::kSeen, &RobotDetection::state));
  false_robots_ += seen_robots - seen.size();
  return all_right && seen_robots == seen.size();
}

void Scorecard::judge_identities(const std::vector<Pair>& seen) {
  std::vector<bool> in_exchange(seen.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Pair& a = seen[k];
      const Pair& b = seen[i];
      const TrueIdentity& name_a = robots_[a.robot].identity;
      const TrueIdentity& name_b = robots_[b.robot].identity;
      const bool exchanged = bears(*a.found, name_b) && bears(*b.found, name_a) &&
                             !bears(*a.found, name_a) && !bears(*b.found, name_b);
      const auto key = std::minmax(a.robot, b.robot);
      if (!exchanged) {
        exchanged_.erase(key);
        continue;
      }
      in_exchange[i] = in_exchange[k] = true;
      if (exchanged_.insert(key).second) ++swaps_;
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    RobotTally& robot = robots_[seen[i].robot];
    switch (compare(*seen[i].found, robot.identity)) {
      case IdentityAnswer::kRight: ++robot.tally.right_identity; break;
      case IdentityAnswer::kUnknown: ++robot.tally.unknown_identity; break;
      case IdentityAnswer::kWrong: ++robot.tally.wrong_identity; break;
    }
    if (in_exchange[i]) ++robot.tally.exchanged;
  }
}

bool Scorecard::judge_ball(const Detections& found, const TrueScene& truth, const Field& field) {
  const double height_mm = field.ball_height_mm();
  const bool is_seen = found.ball && found.ball->state == TrackState::kSeen;
  if (!truth.ball) {
    if (is_seen) ++false_balls_;
    return !is_seen;
  }
  ++ball_.frames;
  if (!found.ball) return false;
  const Ruler ruler(tolerance_, field);
  const Place place = place_of(*truth.ball, field, height_mm);
  const double apart = ruler.apart(*found.ball, place);
  const bool is_there = apart <= ruler.gate(place, height_mm);
  if (!is_seen) {
    if (is_there) ++ball_.predicted;
    return false;
  }
  if (!is_there) {
    ++false_balls_;
    return false;
  }
  ++ball_.seen;
  tally_place(*found.ball, place, ball_);
  if (!ruler.is_near(apart)) return false;
  ++ball_.within_tolerance;
  return true;
}

}  // namespace maggic
