#include "scan/run_buffer.hpp"

#include <algorithm>

namespace maggic {

void RunBuffer::grow(std::size_t needed) {
  const std::size_t capacity = std::max(needed, 2 * capacity_);
  auto runs = std::make_unique_for_overwrite<Run[]>(capacity);
  std::copy_n(runs_.get(), size_, runs.get());
  runs_ = std::move(runs);
  capacity_ = capacity;
}

}  // namespace maggic
