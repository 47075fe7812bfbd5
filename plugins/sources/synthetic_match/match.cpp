#include "match.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace maggic::synthetic_match {
namespace {

constexpr double kRobotRadiusMm = kRobotSideMm * std::numbers::sqrt2 / 2.0;
constexpr double kRobotDistanceMm = 2.0 * kRobotRadiusMm + 4.0;  // a dark gap stays visible
constexpr double kBallGapMm = 6.0;  // keeps blurred ball and robot apart in the picture
constexpr double kTouchMm = 3.0;    // the ball bounces before the hard limit is reached

constexpr double kMaxStepS = 1.0 / 480.0;
constexpr double kMaxSpeed = 900.0;
constexpr double kAcceleration = 3000.0;
constexpr double kBraking = 4500.0;
constexpr double kMaxOmega = 8.0;
constexpr double kAngularAcceleration = 70.0;
constexpr double kAvoidanceMm = 230.0;

constexpr double kMaxBallSpeed = 1600.0;
constexpr double kBallFriction = 250.0;
constexpr double kWallBounce = 0.8;
constexpr double kRobotBounce = 0.6;

double norm(cv::Point2d p) { return std::hypot(p.x, p.y); }

double wrap(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

cv::Point2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

cv::Point2d RobotMotion::velocity_mm_s() const { return direction(heading_rad) * speed_mm_s; }

Match::Match(const MatchParameters& parameters)
    : parameters_(parameters), random_(parameters.seed) {
  const double x = parameters.length_mm / 2.0;
  const double y = parameters.width_mm / 2.0;
  const double diagonal = (x + y - kCornerTriangleMm) / std::numbers::sqrt2;
  const double s = 1.0 / std::numbers::sqrt2;
  walls_ = {{{{1, 0}, x}, {{-1, 0}, x}, {{0, 1}, y}, {{0, -1}, y},
             {{s, s}, diagonal}, {{-s, s}, diagonal}, {{s, -s}, diagonal}, {{-s, -s}, diagonal}}};
  ball_.velocity_mm_s = direction(random_.uniform(-3.0, 3.0)) * 600.0;
  place_robots();
}

void Match::place_robots() {
  const auto count = static_cast<std::size_t>(2 * parameters_.robots_per_team);
  plans_.resize(count);
  constexpr int kTries = 20'000;
  int tries = 0;
  while (robots_.size() < count) {
    if (++tries > kTries) {
      throw std::invalid_argument(fmt::format(
          "{} robots a team do not fit onto a field of {} x {} mm: expected fewer, or a larger field",
          parameters_.robots_per_team, parameters_.length_mm, parameters_.width_mm));
    }
    const bool left = robots_.size() < count / 2;
    RobotMotion robot;
    robot.position_mm = {random_.uniform(0.0, 0.5) * parameters_.length_mm * (left ? -1.0 : 1.0),
                         random_.uniform(-0.5, 0.5) * parameters_.width_mm};
    robot.heading_rad = random_.uniform(-std::numbers::pi, std::numbers::pi);
    if (!robot_may_be_at(robots_.size(), robot)) continue;
    robots_.push_back(robot);
    plans_[robots_.size() - 1].target_mm = robot.position_mm;
  }
}

void Match::advance() {
  const int steps = std::max(1, static_cast<int>(std::ceil(parameters_.frame_time_s / kMaxStepS)));
  for (int i = 0; i < steps; ++i) step(parameters_.frame_time_s / steps);
}

void Match::step(double dt_s) {
  time_s_ += dt_s;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    plan(i);
    steer(i, dt_s);
  }
  for (const RobotMotion& robot : robots_) push_ball(robot);
  roll_ball(dt_s);
  free_stuck_ball(dt_s);
}

void Match::plan(std::size_t robot) {
  const std::size_t team_size = robots_.size() / 2;
  const std::size_t role = robot % team_size;
  const double side = robot < team_size ? -1.0 : 1.0;  // of the goal it defends
  const cv::Point2d ball = ball_.position_mm;
  Plan& plan = plans_[robot];

  if (role == 0 && team_size > 1) {  // keeper: between ball and goal
    plan.target_mm = {side * (parameters_.length_mm / 2.0 - 90.0), std::clamp(ball.y, -170.0, 170.0)};
    return;
  }
  if (role == 1 && time_s_ >= ball_left_alone_until_s_) {  // attacker: from behind, through the ball
    const cv::Point2d goal(-side * parameters_.length_mm / 2.0, 0.0);
    const cv::Point2d aim = (goal - ball) / std::max(norm(goal - ball), 1.0);
    const cv::Point2d from = ball - robots_[robot].position_mm;
    const bool behind = from.dot(aim) > 0.85 * norm(from);
    plan.target_mm = behind ? ball + aim * 120.0 : ball - aim * 160.0;
    return;
  }
  if (time_s_ < plan.replan_at_s) return;
  plan.replan_at_s = time_s_ + random_.uniform(0.7, 2.2);
  const cv::Point2d anywhere(random_.uniform(-0.45, 0.45) * parameters_.length_mm,
                             random_.uniform(-0.42, 0.42) * parameters_.width_mm);
  plan.target_mm = 0.35 * ball + 0.65 * anywhere;
}

double Match::wished_turn(std::size_t robot, double& distance_mm) const {
  const cv::Point2d position = robots_[robot].position_mm;
  const cv::Point2d to_target = plans_[robot].target_mm - position;
  distance_mm = norm(to_target);
  cv::Point2d wish = to_target / std::max(distance_mm, 100.0);
  for (std::size_t other = 0; other < robots_.size(); ++other) {
    if (other == robot) continue;
    const cv::Point2d away = position - robots_[other].position_mm;
    const double distance = norm(away);
    if (distance >= kAvoidanceMm) continue;
    // Partly sideways, always to the same hand, so that two robots pass rather than face.
    const double strength =
        (kAvoidanceMm - distance) / (kAvoidanceMm - kRobotDistanceMm) / distance;
    wish += strength * (away + 0.8 * cv::Point2d(-away.y, away.x));
  }
  return wrap(std::atan2(wish.y, wish.x) - robots_[robot].heading_rad);
}

double Match::safe_speed(std::size_t robot, double speed_mm_s) const {
  const RobotMotion& self = robots_[robot];
  const cv::Point2d forward = direction(self.heading_rad) * (speed_mm_s < 0.0 ? -1.0 : 1.0);
  double speed = std::abs(speed_mm_s);
  const auto limit = [&](cv::Point2d towards, double gap_mm) {
    const double closing = forward.dot(towards);
    if (closing <= 0.0) return;
    speed = std::min(speed, std::sqrt(2.0 * kBraking * std::max(gap_mm - 1.0, 0.0)) / closing);
  };
  for (const Wall& wall : walls_) {
    limit(wall.normal, wall.distance_mm - kRobotRadiusMm - wall.normal.dot(self.position_mm));
  }
  for (std::size_t other = 0; other < robots_.size(); ++other) {
    if (other == robot) continue;
    const cv::Point2d to = robots_[other].position_mm - self.position_mm;
    // Half the gap: the other one may be coming.
    limit(to / norm(to), 0.5 * (norm(to) - kRobotDistanceMm));
  }
  return std::copysign(speed, speed_mm_s);
}

void Match::steer(std::size_t robot, double dt_s) {
  RobotMotion& self = robots_[robot];
  Plan& plan = plans_[robot];
  double distance = 0.0;
  double turn = wished_turn(robot, distance);
  // Either end may lead; changing it needs a clear reason, or the robot would dither.
  if (std::cos(turn) * plan.direction < -0.3) plan.direction = -plan.direction;
  if (plan.direction < 0.0) turn = wrap(turn + std::numbers::pi);
  const double ahead = std::max(std::cos(turn), 0.0);
  const double wished_speed =
      plan.direction * kMaxSpeed * ahead * ahead * std::min(distance / 250.0, 1.0);
  const double wished_omega =
      distance < 8.0 ? 0.0 : std::clamp(6.0 * turn, -kMaxOmega, kMaxOmega);

  RobotMotion next = self;
  next.speed_mm_s += std::clamp(wished_speed - self.speed_mm_s, -kAcceleration * dt_s,
                                kAcceleration * dt_s);
  next.speed_mm_s = safe_speed(robot, next.speed_mm_s);
  next.omega_rad_s += std::clamp(wished_omega - self.omega_rad_s, -kAngularAcceleration * dt_s,
                                 kAngularAcceleration * dt_s);
  // Trapezoids, so that the velocities reported are those of this very moment.
  next.heading_rad = wrap(self.heading_rad + 0.5 * (self.omega_rad_s + next.omega_rad_s) * dt_s);
  next.position_mm += 0.5 * dt_s * (self.velocity_mm_s() + next.velocity_mm_s());
  if (robot_may_be_at(robot, next)) {
    self = next;
  } else {
    self.speed_mm_s = 0.0;
    self.omega_rad_s = 0.0;
  }
}

bool Match::robot_may_be_at(std::size_t robot, const RobotMotion& motion) const {
  for (const Wall& wall : walls_) {
    if (wall.normal.dot(motion.position_mm) > wall.distance_mm - kRobotRadiusMm) return false;
  }
  for (std::size_t other = 0; other < robots_.size(); ++other) {
    if (other == robot) continue;
    if (norm(robots_[other].position_mm - motion.position_mm) < kRobotDistanceMm) return false;
  }
  return ball_gap(motion, ball_.position_mm, nullptr) >= 0.0;
}

double Match::ball_gap(const RobotMotion& robot, cv::Point2d ball_mm, cv::Point2d* away) const {
  const cv::Point2d x = direction(robot.heading_rad);
  const cv::Point2d y(-x.y, x.x);
  const cv::Point2d offset = ball_mm - robot.position_mm;
  const cv::Point2d local(x.dot(offset), y.dot(offset));
  const double half = kRobotSideMm / 2.0;
  const cv::Point2d outside(std::max(std::abs(local.x) - half, 0.0),
                            std::max(std::abs(local.y) - half, 0.0));
  const double distance = norm(outside);
  if (away != nullptr) {
    *away = distance > 0.0 ? (x * std::copysign(outside.x, local.x) +
                              y * std::copysign(outside.y, local.y)) / distance
                           : x;
  }
  const double hidden =
      parameters_.parallax_gain * (norm(robot.position_mm - parameters_.below_camera_mm) +
                                   kRobotRadiusMm);
  return distance - (kBallRadiusMm + kBallGapMm + hidden);
}

void Match::push_ball(const RobotMotion& robot) {
  cv::Point2d away;
  if (ball_gap(robot, ball_.position_mm, &away) >= kTouchMm) return;
  const cv::Point2d arm = ball_.position_mm - robot.position_mm;
  const cv::Point2d surface =
      robot.velocity_mm_s() + robot.omega_rad_s * cv::Point2d(-arm.y, arm.x);
  const double closing = -away.dot(ball_.velocity_mm_s - surface);
  if (closing > 0.0) ball_.velocity_mm_s += (1.0 + kRobotBounce) * closing * away;
}

void Match::roll_ball(double dt_s) {
  cv::Point2d& velocity = ball_.velocity_mm_s;
  const double speed = norm(velocity);
  const double next_speed = std::clamp(speed - kBallFriction * dt_s, 0.0, kMaxBallSpeed);
  const cv::Point2d slowed = speed > 0.0 ? velocity * (next_speed / speed) : velocity;
  cv::Point2d next = ball_.position_mm + 0.5 * dt_s * (velocity + slowed);
  velocity = slowed;
  for (const Wall& wall : walls_) {
    const double depth = wall.normal.dot(next) - (wall.distance_mm - kBallRadiusMm);
    if (depth <= 0.0) continue;
    next -= depth * wall.normal;
    const double into = wall.normal.dot(velocity);
    if (into > 0.0) velocity -= (1.0 + kWallBounce) * into * wall.normal;
  }
  for (const RobotMotion& robot : robots_) {
    if (ball_gap(robot, next, nullptr) < 0.0) {  // squeezed: stay until something gives way
      velocity *= 0.5;
      return;
    }
  }
  for (const Wall& wall : walls_) {  // pushing it out of one wall may have pushed it into another
    if (wall.normal.dot(next) > wall.distance_mm - kBallRadiusMm + 1e-9) return;
  }
  ball_.position_mm = next;
}

void Match::free_stuck_ball(double dt_s) {
  ball_at_rest_s_ = norm(ball_.velocity_mm_s) < 80.0 ? ball_at_rest_s_ + dt_s : 0.0;
  if (ball_at_rest_s_ < 1.0) return;
  // Like a referee's free ball: attackers step back, the ball rolls towards the middle.
  ball_at_rest_s_ = 0.0;
  ball_left_alone_until_s_ = time_s_ + 1.2;
  const cv::Point2d middle(random_.uniform(-200.0, 200.0), random_.uniform(-200.0, 200.0));
  const cv::Point2d to_middle = middle - ball_.position_mm;
  ball_.velocity_mm_s = to_middle * (700.0 / std::max(norm(to_middle), 1.0));
}

}  // namespace maggic::synthetic_match
