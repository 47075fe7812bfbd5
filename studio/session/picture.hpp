#pragma once
/// One view of one frame, ready to be sent.

#include <cstdint>
#include <vector>

namespace maggic::studio {

struct Picture {
  std::uint64_t sequence = 0;  ///< Counts up from 1; not the number of the frame.
  std::vector<std::uint8_t> jpeg;
};

}  // namespace maggic::studio
