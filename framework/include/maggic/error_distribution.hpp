#pragma once
/// Errors of one kind over many frames: root of the mean square, quantiles, largest.

#include <cstdint>

#include "maggic/log_histogram.hpp"

namespace maggic {

/// Constant memory. Signs do not count.
class ErrorDistribution {
 public:
  ErrorDistribution();
  /// @param error finite, in any unit; all of one distribution in the same.
  void add(double error);
  void merge(const ErrorDistribution& other);

  std::uint64_t count() const { return histogram_.count(); }
  /// Root of the mean square; 0 when nothing was added.
  double rmse() const;
  /// @param q in [0, 1]. @return exact to 1 % from 1e-4 to 1e5 of the unit, never above `max`; 0
  ///   when nothing was added.
  double quantile(double q) const;
  double max() const { return max_; }

 private:
  LogHistogram histogram_;
  double squares_ = 0.0;
  double max_ = 0.0;
};

}  // namespace maggic
