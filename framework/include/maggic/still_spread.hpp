#pragma once
/// How much the reported place of an object jitters while the object stands still.

#include <cstdint>
#include <optional>

#include <opencv2/core/types.hpp>

namespace maggic {

/// Spread of reported places round their own mean, over every stretch of frames in which the true
/// place does not change. A constant bias is no jitter. Stretches of less than `kMinFrames` reports
/// do not count.
class StillSpread {
 public:
  static constexpr std::uint64_t kMinFrames = 5;

  /// @param found,truth of one frame, in one unit. A true place that differs from the stretch's
  ///   first by more than 1e-3 begins a new stretch.
  void add(cv::Point2d found, cv::Point2d truth);
  void merge(const StillSpread& other);

  /// Root of the mean squared distance from the mean, unbiased (divided by n − 1 a stretch);
  /// nothing without a long enough stretch.
  std::optional<double> deviation() const;

 private:
  bool counts() const { return frames_ >= kMinFrames; }
  void end_stretch();

  double squares_ = 0.0;       // of finished stretches, about their means
  std::uint64_t freedom_ = 0;  // of finished stretches: frames less one each
  std::uint64_t frames_ = 0;   // of the current stretch, as are all below
  cv::Point2d truth_;
  cv::Point2d mean_;
  double squares_now_ = 0.0;
};

}  // namespace maggic
