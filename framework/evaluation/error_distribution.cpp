#include "maggic/error_distribution.hpp"

#include <algorithm>
#include <cmath>

namespace maggic {
namespace {

constexpr double kSmallest = 1e-4;
constexpr double kLargest = 1e5;

}  // namespace

ErrorDistribution::ErrorDistribution() : histogram_(kSmallest, kLargest) {}

void ErrorDistribution::add(double error) {
  histogram_.add(std::abs(error));
  squares_ += error * error;
  max_ = std::max(max_, std::abs(error));
}

void ErrorDistribution::merge(const ErrorDistribution& other) {
  histogram_.merge(other.histogram_);
  squares_ += other.squares_;
  max_ = std::max(max_, other.max_);
}

double ErrorDistribution::rmse() const {
  return count() == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count()));
}

double ErrorDistribution::quantile(double q) const {
  return std::min(histogram_.quantile(q), max_);
}

}  // namespace maggic
