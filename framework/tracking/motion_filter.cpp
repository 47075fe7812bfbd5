#include "tracking/motion_filter.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/angles.hpp"

namespace maggic::tracking {
namespace {

// Before a second sighting an object may move as fast as the rules of physics on the field let it.
constexpr double kUnknownTurningRadS = 20.0;
constexpr double kSurprise = 3.5;  // in standard deviations of the innovation
constexpr double kShortestStepS = 1e-3;
constexpr double kTurnLastsS = 0.1;

struct Gain {
  double value;
  double rate;
};

Gain correct(MotionVariance& v, double noise) {
  const double innovation_variance = v.value + noise * noise;
  const Gain gain{v.value / innovation_variance, v.cross / innovation_variance};
  v.rate -= gain.rate * v.cross;
  v.cross *= 1.0 - gain.value;
  v.value *= 1.0 - gain.value;
  return gain;
}

}  // namespace

void MotionVariance::predict(double dt_s, double acceleration) {
  // White noise of the acceleration, held constant within the step.
  const double velocity_step = acceleration * dt_s;
  const double q = velocity_step * velocity_step;
  value += dt_s * (2.0 * cross + dt_s * rate) + q * dt_s * dt_s / 4.0;
  cross += dt_s * rate + q * dt_s / 2.0;
  rate += q;
}

void MotionVariance::open_for_jump(double innovation, double noise, double dt_s) {
  if (innovation * innovation <= kSurprise * kSurprise * (value + noise * noise)) return;
  const double dt = std::max(dt_s, kShortestStepS);
  // A velocity that was wrong over the last step explains the place and should be corrected too.
  value = std::max(value, innovation * innovation);
  rate = std::max(rate, value / (dt * dt));
  cross = 0.95 * std::sqrt(value * rate);
}

void PositionFilter::start(cv::Point2d position_mm, double noise_mm, double max_speed_mm_s) {
  position_mm_ = position_mm;
  velocity_mm_s_ = {};
  variance_ = {noise_mm * noise_mm, 0.0, max_speed_mm_s * max_speed_mm_s / 4.0};
  last_dt_s_ = 0.0;
}

void PositionFilter::predict(double dt_s, double acceleration_mm_s2) {
  position_mm_ += velocity_mm_s_ * dt_s;
  variance_.predict(dt_s, acceleration_mm_s2);
  last_dt_s_ = dt_s;
}

void PositionFilter::correct(cv::Point2d measured_mm, double noise_mm) {
  const cv::Point2d innovation = measured_mm - position_mm_;
  variance_.open_for_jump(std::hypot(innovation.x, innovation.y), noise_mm, last_dt_s_);
  const Gain gain = tracking::correct(variance_, noise_mm);
  position_mm_ += gain.value * innovation;
  velocity_mm_s_ += gain.rate * innovation;
}

void PositionFilter::clamp(cv::Point2d limit_mm) {
  const auto clamp_axis = [](double& position, double& velocity, double limit) {
    if (std::abs(position) <= limit) return;
    position = std::copysign(limit, position);
    velocity = 0.0;
  };
  clamp_axis(position_mm_.x, velocity_mm_s_.x, limit_mm.x);
  clamp_axis(position_mm_.y, velocity_mm_s_.y, limit_mm.y);
}

double PositionFilter::sigma_mm() const { return std::sqrt(variance_.value); }

void HeadingFilter::start(double heading_rad, double noise_rad) {
  heading_rad_ = wrap_turn(heading_rad);
  rate_rad_s_ = 0.0;
  variance_ = {noise_rad * noise_rad, 0.0, kUnknownTurningRadS * kUnknownTurningRadS / 4.0};
  last_dt_s_ = 0.0;
}

void HeadingFilter::predict(double dt_s, double angular_acceleration_rad_s2) {
  heading_rad_ = wrap_turn(heading_rad_ + rate_rad_s_ * dt_s);
  variance_.predict(dt_s, angular_acceleration_rad_s2);
  last_dt_s_ = dt_s;
}

void HeadingFilter::correct(double measured_rad, double noise_rad) {
  const double innovation = wrap_turn(measured_rad - heading_rad_);
  variance_.open_for_jump(innovation, noise_rad, last_dt_s_);
  const Gain gain = tracking::correct(variance_, noise_rad);
  heading_rad_ = wrap_turn(heading_rad_ + gain.value * innovation);
  rate_rad_s_ += gain.rate * innovation;
}

void HeadingFilter::slow_down(double dt_s) { rate_rad_s_ *= std::exp(-dt_s / kTurnLastsS); }

double HeadingFilter::sigma_rad() const { return std::sqrt(variance_.value); }

}  // namespace maggic::tracking
