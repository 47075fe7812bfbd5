#pragma once
/// Cubes that the colour cube is cut into.

#include <cstddef>
#include <cstdint>

#include "maggic/color_box.hpp"
#include "maggic/color_table.hpp"

namespace maggic {

/// A cube of side³ colours. The side is a power of two from 2 to 128, and the lowest channels are
/// multiples of it.
struct ColorCell {
  std::uint8_t b, g, r;  ///< Of the colour with the smallest channels.
  std::uint8_t side;

  ColorBox box() const { return {range(b), range(g), range(r)}; }

  /// The lower (0) or upper (1) half in blue, green and red, by the bits of `i` from the lowest.
  ColorCell octant(unsigned i) const {
    const unsigned half = side / 2U;
    return {static_cast<std::uint8_t>(b + (i & 1U) * half),
            static_cast<std::uint8_t>(g + (i >> 1 & 1U) * half),
            static_cast<std::uint8_t>(r + (i >> 2) * half), static_cast<std::uint8_t>(half)};
  }

  /// Cell number `i` of those of one side, blue changing fastest.
  static ColorCell at(std::size_t i, std::uint8_t side) {
    const std::size_t per_side = 256U / side;
    return {static_cast<std::uint8_t>(i % per_side * side),
            static_cast<std::uint8_t>(i / per_side % per_side * side),
            static_cast<std::uint8_t>(i / (per_side * per_side) * side), side};
  }

 private:
  ChannelRange range(std::uint8_t first) const {
    return {first, static_cast<std::uint8_t>(first + side - 1)};
  }
};

}  // namespace maggic
