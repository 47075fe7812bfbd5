#include "maggic/step_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace maggic {
namespace {

constexpr double kSmallestNs = 100.0;
constexpr double kLargestNs = 1e11;

}  // namespace

DurationHistogram::DurationHistogram() : histogram_ns_(kSmallestNs, kLargestNs) {}

void DurationHistogram::add(std::chrono::nanoseconds value) {
  histogram_ns_.add(static_cast<double>(value.count()));
  sum_ += value;
  max_ = std::max(max_, value);
}

std::chrono::nanoseconds DurationHistogram::quantile(double q) const {
  return std::min(std::chrono::nanoseconds(std::llround(histogram_ns_.quantile(q))), max_);
}

std::chrono::nanoseconds DurationHistogram::mean() const {
  const auto count = static_cast<std::int64_t>(histogram_ns_.count());
  return count == 0 ? std::chrono::nanoseconds(0) : sum_ / count;
}

void StepStatistics::add(const StepTimes& times) {
  for (std::size_t i = 0; i < steps_.size(); ++i) steps_[i].add(times.of[i]);
  frame_path_.add(times.frame_path());
}

}  // namespace maggic
