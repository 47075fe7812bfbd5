#pragma once
/// Constant-velocity Kalman filters driven by real time.

#include <opencv2/core/types.hpp>

namespace maggic::tracking {

/// Shared uncertainty of one coordinate and its velocity.
struct MotionVariance {
  double value = 0.0;
  double cross = 0.0;
  double rate = 0.0;

  /// The object may change its rate by `acceleration` (one sigma) at any time within `dt_s`.
  void predict(double dt_s, double acceleration);
  /// Makes room for a measurement the motion model cannot explain (a collision, a kick), so that
  /// the estimate follows it instead of lagging.
  void open_for_jump(double innovation, double noise, double dt_s);
};

/// A point that moves over the field.
class PositionFilter {
 public:
  /// At rest until a second measurement tells otherwise.
  void start(cv::Point2d position_mm, double noise_mm, double max_speed_mm_s);
  void predict(double dt_s, double acceleration_mm_s2);
  void correct(cv::Point2d measured_mm, double noise_mm);
  /// Keeps the position within ± `limit_mm`; what would leave loses its velocity.
  void clamp(cv::Point2d limit_mm);

  cv::Point2d position_mm() const { return position_mm_; }
  cv::Point2d velocity_mm_s() const { return velocity_mm_s_; }
  /// Standard deviation of the position along one axis.
  double sigma_mm() const;

 private:
  cv::Point2d position_mm_;
  cv::Point2d velocity_mm_s_;
  MotionVariance variance_;
  double last_dt_s_ = 0.0;
};

/// A direction that turns; angles wrap.
class HeadingFilter {
 public:
  void start(double heading_rad, double noise_rad);
  void predict(double dt_s, double angular_acceleration_rad_s2);
  void correct(double measured_rad, double noise_rad);

  /// Without measurements a robot is ever less likely to keep turning as it did.
  void slow_down(double dt_s);

  double heading_rad() const { return heading_rad_; }
  double rate_rad_s() const { return rate_rad_s_; }
  double sigma_rad() const;

 private:
  double heading_rad_ = 0.0;
  double rate_rad_s_ = 0.0;
  MotionVariance variance_;
  double last_dt_s_ = 0.0;
};

}  // namespace maggic::tracking
