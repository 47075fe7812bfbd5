#include "measurement/cache_eviction.hpp"

#include <algorithm>
#include <numeric>

#include "maggic/machine_description.hpp"

namespace maggic {
namespace {

constexpr std::size_t kSmallest = std::size_t{64} << 20;

}  // namespace

// Not zero: pages of zeros that nobody wrote to can be one and the same page.
CacheEvictor::CacheEvictor()
    : memory_(std::max(kSmallest, 2 * describe_machine().last_level_cache_bytes) /
                  sizeof(std::uint64_t),
              1) {}

void CacheEvictor::evict() {
  sum_ = std::accumulate(memory_.begin(), memory_.end(), std::uint64_t{0});
}

}  // namespace maggic
