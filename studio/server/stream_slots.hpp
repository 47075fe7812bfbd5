#pragma once
/// How many streams of a kind may be open at once.

#include <algorithm>
#include <atomic>
#include <memory>

namespace maggic::studio {

/// Thread-safe; outlives what was taken of it.
class StreamSlots {
 public:
  explicit StreamSlots(int most) : most_(most) {}

  /// A slot for as long as the answer lives. @return null when all are taken.
  std::shared_ptr<void> take() {
    if (open_.fetch_add(1) >= most_) {
      open_.fetch_sub(1);
      return nullptr;
    }
    return {this, [](StreamSlots* slots) { slots->open_.fetch_sub(1); }};
  }
  int open() const { return std::min(open_.load(), most_); }
  int most() const { return most_; }

 private:
  const int most_;
  std::atomic<int> open_{0};
};

}  // namespace maggic::studio
