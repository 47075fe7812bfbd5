#pragma once
/// Storage for millions of labels that are about to be written.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "maggic/palette.hpp"
#include "maggic/table_memory.hpp"

namespace maggic {

/// Table memory, and elements that begin with any value: nothing is cleared that is overwritten right
/// away.
template <class T>
struct UnclearedAllocator {
  using value_type = T;

  UnclearedAllocator() = default;
  template <class U>
  explicit UnclearedAllocator(const UnclearedAllocator<U>& /*other*/) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_table_memory(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { free_table_memory(memory, count * sizeof(T)); }

  template <class U>
  void construct(U* element) {
    ::new (static_cast<void*>(element)) U;
  }
  template <class U, class... Args>
  void construct(U* element, Args&&... args) {
    ::new (static_cast<void*>(element)) U(std::forward<Args>(args)...);
  }

  friend bool operator==(const UnclearedAllocator&, const UnclearedAllocator&) { return true; }
};

/// What `resize` adds has any value until it is written.
using LabelVector = std::vector<Label, UnclearedAllocator<Label>>;

}  // namespace maggic
