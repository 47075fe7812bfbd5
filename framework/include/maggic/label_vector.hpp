#pragma once
/// Storage for millions of labels that are about to be written.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "maggic/palette.hpp"

namespace maggic {

/// Memory that begins with a cache line, and elements that begin with any value: nothing is cleared
/// that is overwritten right away.
template <class T>
struct UnclearedAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  UnclearedAllocator() = default;
  template <class U>
  explicit UnclearedAllocator(const UnclearedAllocator<U>& /*other*/) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
  }
  void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, kAlignment); }

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
