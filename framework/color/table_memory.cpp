#include "maggic/table_memory.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace maggic {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

// A smaller table would leave most of a huge page unused.
constexpr std::size_t kFewestBytes = std::size_t{1} << 20;

std::align_val_t alignment_for(std::size_t bytes) {
  return std::align_val_t{bytes < kFewestBytes ? 64 : kHugePage};
}

}  // namespace

void* allocate_table_memory(std::size_t bytes) {
  if (bytes < kFewestBytes) return ::operator new(bytes, alignment_for(bytes));
  // Whole pages, so that no neighbour shares the last one.
  const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* memory = ::operator new(whole, alignment_for(bytes));
#ifdef __linux__
  // A wish: nothing depends on its success.
  static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_table_memory(void* memory, std::size_t bytes) {
  ::operator delete(memory, alignment_for(bytes));
}

}  // namespace maggic
