#pragma once
/// The match without its picture: robots and ball that move smoothly and never overlap.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "random.hpp"

namespace maggic::synthetic_match {

inline constexpr double kRobotSideMm = 75.0;
inline constexpr double kBallRadiusMm = 21.35;
inline constexpr double kCornerTriangleMm = 70.0;

struct MatchParameters {
  double length_mm = 1500.0;
  double width_mm = 1300.0;
  int robots_per_team = 3;
  std::uint64_t seed = 1;
  double frame_time_s = 1.0 / 60.0;
  /// Seen from the camera a robot's top lies further out than the ball's outline by this part of
  /// its distance from the point below the camera; the ball keeps clear of it.
  double parallax_gain = 0.03;
  cv::Point2d below_camera_mm{0.0, 0.0};
};

struct RobotMotion {
  cv::Point2d position_mm;
  double heading_rad = 0.0;
  double speed_mm_s = 0.0;  ///< Along the heading; negative when driving backwards.
  double omega_rad_s = 0.0;

  cv::Point2d velocity_mm_s() const;
};

struct BallMotion {
  cv::Point2d position_mm;
  cv::Point2d velocity_mm_s;
};

/// Robots 0 … n−1 defend the left goal, n … 2n−1 the right one. Deterministic by seed.
///
/// A step of a robot or the ball that would make it overlap anything is not taken, so whatever the
/// steering wishes, robots keep the distance of their circumcircles and the ball stays visible.
class Match {
 public:
  /// @throws std::invalid_argument when so many robots do not fit onto the field.
  explicit Match(const MatchParameters& parameters);

  /// On to the next frame; the first one shows the match as constructed.
  void advance();

  const std::vector<RobotMotion>& robots() const { return robots_; }
  const BallMotion& ball() const { return ball_; }

 private:
  struct Plan {
    cv::Point2d target_mm;
    double replan_at_s = 0.0;
    double direction = 1.0;  ///< −1 while driving backwards.
  };
  struct Wall {  ///< Points with normal · p ≤ distance are inside.
    cv::Point2d normal;
    double distance_mm;
  };

  void place_robots();
  void step(double dt_s);
  void plan(std::size_t robot);
  void steer(std::size_t robot, double dt_s);
  double wished_turn(std::size_t robot, double& distance_mm) const;
  double safe_speed(std::size_t robot, double speed_mm_s) const;
  bool robot_may_be_at(std::size_t robot, const RobotMotion& motion) const;
  void push_ball(const RobotMotion& robot);
  void roll_ball(double dt_s);
  void free_stuck_ball(double dt_s);

  /// Distance the ball's centre has from where it would touch the robot, and the direction away.
  double ball_gap(const RobotMotion& robot, cv::Point2d ball_mm, cv::Point2d* away) const;

  MatchParameters parameters_;
  Random random_;
  std::array<Wall, 8> walls_;
  std::vector<RobotMotion> robots_;
  std::vector<Plan> plans_;
  BallMotion ball_;
  double time_s_ = 0.0;
  double ball_at_rest_s_ = 0.0;
  double ball_left_alone_until_s_ = 0.0;
};

}  // namespace maggic::synthetic_match
