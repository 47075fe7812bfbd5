#pragma once
/// Quantiles of many numbers in constant memory.

#include <cstdint>
#include <vector>

namespace maggic {

/// Counts numbers in logarithmic buckets of 1 % width. Numbers outside of the range count in its
/// first or last bucket.
class LogHistogram {
 public:
  /// @param smallest,largest above 0, in whatever unit the numbers have.
  LogHistogram(double smallest, double largest);

  void add(double value);
  /// Adds what another histogram of the same range holds.
  void merge(const LogHistogram& other);

  std::uint64_t count() const { return count_; }

  /// @param q in [0, 1]. @return the smallest number that a share `q` of all lies at or below,
  ///   exact to 1 % inside the range; 0 when nothing was added.
  double quantile(double q) const;

 private:
  std::size_t bucket_of(double value) const;

  double smallest_;
  double largest_;
  std::vector<std::uint32_t> buckets_;
  std::uint64_t count_ = 0;
};

}  // namespace maggic
