#pragma once
/// Refilling vectors that are used again every frame.

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace maggic {

/// `vector.assign(count, value)` with a capacity that begins with 256 and at least doubles when it
/// has to grow: assign alone grows to just `count`, so that every frame with one element more than
/// all before it would ask for memory.
template <class T>
void fill_with_room(std::vector<T>& vector, std::size_t count,
                    const std::type_identity_t<T>& value) {
  if (count > vector.capacity()) {
    vector.reserve(std::max({count, 2 * vector.capacity(), std::size_t{256}}));
  }
  vector.assign(count, value);
}

}  // namespace maggic
