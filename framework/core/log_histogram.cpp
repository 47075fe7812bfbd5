#include "maggic/log_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace maggic {
namespace {

constexpr double kWidth = 1.01;

}  // namespace

LogHistogram::LogHistogram(double smallest, double largest)
    : smallest_(smallest), largest_(largest), buckets_(bucket_of(largest) + 1) {}

std::size_t LogHistogram::bucket_of(double value) const {
  // Written so that what is not a number counts as the smallest.
  const double inside = value > smallest_ ? std::min(value, largest_) : smallest_;
  return static_cast<std::size_t>(std::log(inside / smallest_) / std::log(kWidth));
}

void LogHistogram::add(double value) {
  ++buckets_[bucket_of(value)];
  ++count_;
}

void LogHistogram::merge(const LogHistogram& other) {
  for (std::size_t i = 0; i < buckets_.size(); ++i) buckets_[i] += other.buckets_[i];
  count_ += other.count_;
}

double LogHistogram::quantile(double q) const {
  if (count_ == 0) return 0.0;
  const auto rank =
      static_cast<std::uint64_t>(std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_)));
  std::uint64_t below = 0;
  std::size_t bucket = 0;
  for (; bucket + 1 < buckets_.size(); ++bucket) {
    below += buckets_[bucket];
    if (below >= std::max<std::uint64_t>(rank, 1)) break;
  }
  // The bucket's geometric middle: at most half a bucket (0.5 %) from any value in it.
  return smallest_ * std::pow(kWidth, static_cast<double>(bucket) + 0.5);
}

}  // namespace maggic
