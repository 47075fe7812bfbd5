#pragma once
/// The longest of a frame's runs: what bounds the work on noise.

#include <cstddef>
#include <span>
#include <vector>

#include "maggic/blob.hpp"

namespace maggic {

/// Leaves out the shortest runs of frames that have too many: noise is short runs and tags are long
/// ones, so tags stay. One caller at a time; allocates nothing once it has seen the busiest frame.
class LongestRuns {
 public:
  /// The runs of `runs` of at least `shortest_px()` pixels, in their order; that is the smallest
  /// length which at most `most` of them reach. All of `runs` where there are no more than `most`;
  /// none where more than `most` share the greatest length.
  /// @param runs outlive the answer, which holds until the next call. @param most at least 1.
  std::span<const Run> keep(std::span<const Run> runs, std::size_t most);

  /// Of the latest call: shorter runs were left out. 1 … 65536; 1: none were.
  int shortest_px() const { return shortest_px_; }

 private:
  int shortest_px_ = 1;
  std::vector<Run> kept_;
};

}  // namespace maggic
