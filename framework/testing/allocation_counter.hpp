#pragma once
/// Counts requests for memory, for tests of code that must not make any.

#include <cstdint>

namespace maggic::testing {

/// Counts what is asked of operator new and by cv::Mat, from its construction on. A picture counts
/// more than once; memory asked of the C library directly is not counted.
class AllocationCounter {
 public:
  /// False in builds with a sanitizer, which need operator new for themselves: nothing is counted.
  static bool works();

  /// Begins to count, from 0.
  AllocationCounter();

  /// By all threads.
  std::uint64_t count() const;
  /// By the thread that calls, which has to be the one that made the counter.
  std::uint64_t count_of_this_thread() const;

 private:
  std::uint64_t before_;
  std::uint64_t before_of_this_thread_;
};

}  // namespace maggic::testing
