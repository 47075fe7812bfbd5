#pragma once
/// How long the steps of the frame path took over many frames.

#include <array>
#include <chrono>
#include <cstdint>

#include "maggic/frame_result.hpp"
#include "maggic/log_histogram.hpp"

namespace maggic {

/// Quantiles over all recorded values, in constant memory: a histogram with logarithmic buckets
/// of 1 % width from 100 ns to 100 s.
class DurationHistogram {
 public:
  DurationHistogram();
  void add(std::chrono::nanoseconds value);
  std::uint64_t count() const { return histogram_ns_.count(); }
  /// @param q in [0, 1]. @return zero when nothing was recorded; exact to 1 %.
  std::chrono::nanoseconds quantile(double q) const;
  std::chrono::nanoseconds max() const { return max_; }
  std::chrono::nanoseconds mean() const;

 private:
  LogHistogram histogram_ns_;
  std::chrono::nanoseconds sum_{0};
  std::chrono::nanoseconds max_{0};
};

/// One histogram a step, and one for the whole frame path.
class StepStatistics {
 public:
  void add(const StepTimes& times);
  const DurationHistogram& of(Step step) const {
    return steps_[static_cast<std::size_t>(step)];
  }
  const DurationHistogram& frame_path() const { return frame_path_; }

 private:
  std::array<DurationHistogram, static_cast<std::size_t>(Step::kCount)> steps_;
  DurationHistogram frame_path_;
};

}  // namespace maggic
