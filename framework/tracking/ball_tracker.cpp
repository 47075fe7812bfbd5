#include "tracking/ball_tracker.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tracking/angles.hpp"

namespace maggic::tracking {
namespace {

constexpr double kMaxElongation = 2.2;  // half hidden by a robot, or smeared by its speed
constexpr double kMinFill = 0.7;
constexpr double kFieldMarginMm = 150.0;
// A kicked ball outruns the robots.
constexpr double kSpeedFactor = 2.0;
constexpr double kReachSlackMm = 40.0;
constexpr double kNearBonus = 3.0;

double distance(cv::Point2d a, cv::Point2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

// How far a blob's centre lies outside of a body, along the nearest side; below 0 inside.
double outside_mm(const RobotBody& body, cv::Point2d position_mm) {
  const cv::Point2d p = body.pose.to_robot(position_mm);
  return std::max(std::abs(p.x), std::abs(p.y)) - body.half_side_mm;
}

}  // namespace

void BallTracker::forget() {
  known_ = false;
  elsewhere_mm_.reset();
}

double BallTracker::reach_mm() const {
  return kReachSlackMm + kSpeedFactor * parameters_.max_speed_mm_s * unseen_s_;
}

double BallTracker::disc_mm2() const {
  const double radius_mm = parameters_.ball_diameter_mm / 2.0;
  return kPi * radius_mm * radius_mm;
}

BallTracker::Look BallTracker::look_at(const TrackerInput& input, std::span<const RobotBody> bodies,
                                       int i) const {
  const Blob& blob = input.blobs[static_cast<std::size_t>(i)];
  const FieldParameters& field = input.field.parameters();
  Look look;
  look.metric = to_metric(blob, i, input.field, input.field.ball_height_mm());
  const MetricBlob& metric = look.metric;
  look.area_ratio = metric.area_mm2 / disc_mm2();
  const auto refuse = [&](Refusal refusal) {
    look.refusal = refusal;
    return look;
  };
  if (look.area_ratio < parameters_.ball_min_area_ratio ||
      look.area_ratio > parameters_.ball_max_area_ratio) {
    return refuse(Refusal::kArea);
  }
  if (metric.elongation() > kMaxElongation) return refuse(Refusal::kElongated);
  if (metric.fill() < kMinFill) return refuse(Refusal::kHollow);
  if (std::abs(metric.position_mm.x) > field.length_mm / 2.0 + kFieldMarginMm ||
      std::abs(metric.position_mm.y) > field.width_mm / 2.0 + kFieldMarginMm) {
    return refuse(Refusal::kOutside);
  }
  // The centre of a whole ball stays a radius away from a body. A sliver of a mislabelled tag
  // lies inside; the larger the blob, the farther out it has to be.
  const double extent_mm = 0.4 * std::sqrt(metric.area_mm2 / kPi);
  // Tags are higher than the ball, so bodies are looked at where tags would be seen.
  const cv::Point2d at_tag_height =
      input.field.to_field_mm(blob.centroid_px, input.field.robot_height_mm());
  if (std::ranges::any_of(bodies, [&](const RobotBody& body) {
        return outside_mm(body, at_tag_height) < extent_mm;
      })) {
    return refuse(Refusal::kInRobot);
  }
  const double size_off = std::log(look.area_ratio) / 0.5;
  const double length_off = std::log(metric.elongation()) / 0.3;
  look.likeness = std::exp(-0.5 * (size_off * size_off + length_off * length_off));
  return look;
}

std::optional<BallTracker::Sighting> BallTracker::best_sighting(
    const TrackerInput& input, std::span<const RobotBody> bodies) const {
  const AreaSieve sieve(input.field, input.field.ball_height_mm(),
                        disc_mm2() * parameters_.ball_min_area_ratio,
                        disc_mm2() * parameters_.ball_max_area_ratio);
  std::optional<Sighting> best;
  double best_score = 0.0;
  for (int i = 0; i < static_cast<int>(input.blobs.size()); ++i) {
    const Blob& blob = input.blobs[static_cast<std::size_t>(i)];
    if (blob.label != parameters_.ball_color || !sieve.passes(blob)) continue;
    const Look look = look_at(input, bodies, i);
    if (look.refusal != Refusal::kNone) continue;
    double score = look.likeness;
    if (known_) {
      const double off = distance(look.metric.position_mm, filter_.position_mm());
      const double width = std::max(15.0, reach_mm() / 2.0);
      score += kNearBonus * std::exp(-0.5 * off * off / (width * width));
    }
    if (!best || score > best_score) {
      best_score = score;
      best = Sighting{i, look.metric.position_mm, std::clamp(0.3 + 0.7 * look.likeness, 0.05, 1.0)};
    }
  }
  return best;
}

void BallTracker::track(const TrackerInput& input, std::span<const RobotBody> bodies, double dt_s) {
  if (known_) {
    filter_.predict(dt_s, parameters_.acceleration_mm_s2);
    unseen_s_ += dt_s;
  }
  const std::optional<Sighting> sighting = best_sighting(input, bodies);
  if (sighting) {
    const bool in_reach =
        known_ && distance(sighting->position_mm, filter_.position_mm()) <= reach_mm();
    const bool seen_there_before =
        elsewhere_mm_ && distance(sighting->position_mm, *elsewhere_mm_) <=
                             kReachSlackMm + kSpeedFactor * parameters_.max_speed_mm_s * dt_s;
    if (!known_ || in_reach || seen_there_before) {
      if (!in_reach) known_ = false;
      accept(*sighting);
      return;
    }
    elsewhere_mm_ = sighting->position_mm;
  } else {
    elsewhere_mm_.reset();
  }
  if (!known_) return;
  if (++missed_frames_ > parameters_.predict_frames) {
    known_ = false;
    return;
  }
  const FieldParameters& field = input.field.parameters();
  filter_.clamp({field.length_mm / 2.0 + kFieldMarginMm, field.width_mm / 2.0 + kFieldMarginMm});
}

void BallTracker::accept(const Sighting& sighting) {
  if (known_) {
    filter_.correct(sighting.position_mm, parameters_.position_noise_mm);
  } else {
    filter_.start(sighting.position_mm, parameters_.position_noise_mm,
                  kSpeedFactor * parameters_.max_speed_mm_s);
  }
  known_ = true;
  seen_ = sighting;
  unseen_s_ = 0.0;
  missed_frames_ = 0;
  elsewhere_mm_.reset();
}

bool BallTracker::is_seen_as(std::size_t blob) const {
  return known_ && missed_frames_ == 0 && seen_.source == static_cast<int>(blob);
}

std::string BallTracker::explain(const TrackerInput& input, std::span<const RobotBody> bodies,
                                 std::size_t blob) const {
  const Look look = look_at(input, bodies, static_cast<int>(blob));
  switch (look.refusal) {
    case Refusal::kArea: {
      const bool small = look.area_ratio < 1.0;
      return fmt::format(
          "not the ball: its {:.0f} mm² are {:.3g} of the ball's disc of {:.0f} mm², {} is {}",
          look.metric.area_mm2, look.area_ratio, disc_mm2(),
          small ? "ball_min_area_ratio" : "ball_max_area_ratio",
          small ? parameters_.ball_min_area_ratio : parameters_.ball_max_area_ratio);
    }
    case Refusal::kElongated:
      return fmt::format("not the ball: {:.1f} times as long as wide, a ball is at most {}",
                         look.metric.elongation(), kMaxElongation);
    case Refusal::kHollow:
      return fmt::format("not the ball: it fills {:.2f} of its outline, a ball at least {}",
                         look.metric.fill(), kMinFill);
    case Refusal::kOutside:
      return fmt::format(
          "not the ball: at {:.0f}, {:.0f} mm it lies more than {:.0f} mm outside of the field",
          look.metric.position_mm.x, look.metric.position_mm.y, kFieldMarginMm);
    case Refusal::kInRobot:
      return "not the ball: it lies within the body of a robot, as a sliver of its tags would";
    case Refusal::kNone: break;
  }
  if (known_ && missed_frames_ == 0) {
    const Look other = look_at(input, bodies, seen_.source);
    const cv::Point2d other_px = input.blobs[static_cast<std::size_t>(seen_.source)].centroid_px;
    return fmt::format(
        "not the ball: the blob at {:.0f},{:.0f} is, {:.0f} mm from here; by size and roundness "
        "it is like a ball to {:.2f}, this one to {:.2f}, and being near the expected place counts "
        "more",
        other_px.x, other_px.y, distance(other.metric.position_mm, look.metric.position_mm),
        other.likeness, look.likeness);
  }
  if (!known_) {
    return "not yet the ball: too far from where it was expected, which is given up now; believed "
           "when seen here again in the next frame";
  }
  const cv::Point2d expected_px =
      input.field.to_image_px(filter_.position_mm(), input.field.ball_height_mm());
  const double off_mm = distance(look.metric.position_mm, filter_.position_mm());
  if (off_mm <= reach_mm()) return "not the ball: another blob was more like one";
  return fmt::format(
      "not yet the ball: {:.0f} mm from the place expected, {:.0f},{:.0f}, of which it can be at "
      "most {:.0f} mm off (max_speed_mm_s); believed when seen here again in the next frame",
      off_mm, expected_px.x, expected_px.y, reach_mm());
}

void BallTracker::report(const TrackerInput& input, Detections& out) const {
  if (!known_) return;
  BallDetection& ball = out.ball.emplace();
  ball.label = parameters_.ball_color;
  ball.position_mm = filter_.position_mm();
  ball.velocity_mm_s = filter_.velocity_mm_s();
  ball.centroid_px = input.field.to_image_px(ball.position_mm, input.field.ball_height_mm());
  ball.confidence = seen_.quality * (1.0 - static_cast<double>(missed_frames_) /
                                               (parameters_.predict_frames + 1.0));
  ball.state = missed_frames_ == 0 ? TrackState::kSeen : TrackState::kPredicted;
  if (missed_frames_ == 0) {
    ball.area_px = input.blobs[static_cast<std::size_t>(seen_.source)].area_px;
  }
}

}  // namespace maggic::tracking
