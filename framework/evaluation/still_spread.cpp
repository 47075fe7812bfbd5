#include "maggic/still_spread.hpp"

#include <cmath>

namespace maggic {
namespace {

constexpr double kSamePlace = 1e-3;

}  // namespace

void StillSpread::end_stretch() {
  if (counts()) {
    squares_ += squares_now_;
    freedom_ += frames_ - 1;
  }
  frames_ = 0;
  mean_ = {};
  squares_now_ = 0.0;
}

void StillSpread::add(cv::Point2d found, cv::Point2d truth) {
  const cv::Point2d moved = truth - truth_;
  if (frames_ > 0 && std::hypot(moved.x, moved.y) > kSamePlace) end_stretch();
  if (frames_ == 0) truth_ = truth;
  // Welford's update: the sum of squares stays exact however far from the origin the object is.
  ++frames_;
  const cv::Point2d before = found - mean_;
  mean_ += before * (1.0 / static_cast<double>(frames_));
  squares_now_ += before.dot(found - mean_);
}

void StillSpread::merge(const StillSpread& other) {
  squares_ += other.squares_;
  freedom_ += other.freedom_;
  if (!other.counts()) return;
  squares_ += other.squares_now_;
  freedom_ += other.frames_ - 1;
}

std::optional<double> StillSpread::deviation() const {
  StillSpread all;
  all.merge(*this);
  if (all.freedom_ == 0) return std::nullopt;
  return std::sqrt(all.squares_ / static_cast<double>(all.freedom_));
}

}  // namespace maggic
