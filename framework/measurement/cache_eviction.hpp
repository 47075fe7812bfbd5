#pragma once
/// Makes the next thing that is measured find nothing in the caches.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace maggic {

/// Reads through memory of twice the size of the last level cache, and at least 64 MiB, so that
/// pictures, tables and results have to come from main memory again, as between two frames of a
/// camera on a machine with other work to do. It evicts this core's caches and the shared one, not
/// those of other cores. Read rather than written: memory still to be written back would slow down
/// what comes next.
class CacheEvictor {
 public:
  CacheEvictor();

  void evict();

  std::size_t bytes() const { return memory_.size() * sizeof(std::uint64_t); }

 private:
  std::vector<std::uint64_t> memory_;
  volatile std::uint64_t sum_ = 0;  ///< Keeps the compiler from leaving the reading out.
};

}  // namespace maggic
