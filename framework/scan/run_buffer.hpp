#pragma once
/// Where the scanner writes its runs.

#include <cstddef>
#include <memory>
#include <span>

#include "maggic/blob.hpp"

namespace maggic {

/// A growing row of runs whose room is not initialised: a row may need as many runs as it has
/// pixels and nearly always needs a few, so clearing the room would cost more than the scan.
class RunBuffer {
 public:
  void clear() { size_ = 0; }

  /// Where `count` more runs can be written. Valid until the next call.
  Run* room_for(std::size_t count) {
    if (size_ + count > capacity_) grow(size_ + count);
    return runs_.get() + size_;
  }

  /// Takes the runs before `end`, which lies in the room given last, as written.
  void end_at(const Run* end) { size_ = static_cast<std::size_t>(end - runs_.get()); }

  std::span<const Run> runs() const { return {runs_.get(), size_}; }

 private:
  void grow(std::size_t needed);

  std::unique_ptr<Run[]> runs_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace maggic
