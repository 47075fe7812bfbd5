#include "maggic/step_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace maggic {
namespace {

constexpr double kSmallestNs = 100.0;
constexpr double kLargestNs = 1e11;
constexpr double kWidth = 1.01;

std::size_t bucket_of(double ns) {
  const double clamped = std::clamp(ns, kSmallestNs, kLargestNs);
  return static_cast<std::size_t>(std::log(clamped / kSmallestNs) / std::log(kWidth));
}

// The bucket's geometric middle: at most half a bucket (0.5 %) from any value in it.
double middle_ns(std::size_t bucket) {
  return kSmallestNs * std::pow(kWidth, static_cast<double>(bucket) + 0.5);
}

}  // namespace

DurationHistogram::DurationHistogram() : buckets_(bucket_of(kLargestNs) + 1) {}

void DurationHistogram::add(std::chrono::nanoseconds value) {
  ++buckets_[bucket_of(static_cast<double>(value.count()))];
  ++count_;
  sum_ += value;
  max_ = std::max(max_, value);
}

std::chrono::nanoseconds DurationHistogram::quantile(double q) const {
  if (count_ == 0) return std::chrono::nanoseconds(0);
  const auto rank = static_cast<std::uint64_t>(
      std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    below += buckets_[i];
    if (below >= std::max<std::uint64_t>(rank, 1)) {
      return std::min(std::chrono::nanoseconds(std::llround(middle_ns(i))), max_);
    }
  }
  return max_;
}

std::chrono::nanoseconds DurationHistogram::mean() const {
  return count_ == 0 ? std::chrono::nanoseconds(0) : sum_ / static_cast<std::int64_t>(count_);
}

void StepStatistics::add(const StepTimes& times) {
  for (std::size_t i = 0; i < steps_.size(); ++i) steps_[i].add(times.of[i]);
  frame_path_.add(times.frame_path());
}

}  // namespace maggic
