#pragma once
/// Batches of colours, one plane a channel, so that work over all 2^24 colours vectorises.

#include <cstddef>
#include <cstdint>
#include <span>

namespace maggic {

/// Colours to read: three planes of equal length; colour i is (b[i], g[i], r[i]).
struct ColorBatch {
  std::span<const std::uint8_t> b;
  std::span<const std::uint8_t> g;
  std::span<const std::uint8_t> r;

  std::size_t size() const { return b.size(); }
};

/// Colours to write; never overlaps a batch being read.
struct MutableColorBatch {
  std::span<std::uint8_t> b;
  std::span<std::uint8_t> g;
  std::span<std::uint8_t> r;

  std::size_t size() const { return b.size(); }
  ColorBatch as_const() const { return {b, g, r}; }
};

}  // namespace maggic
