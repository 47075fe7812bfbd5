#pragma once
/// Hue and saturation as OpenCV's COLOR_BGR2HSV_FULL has them, bit for bit.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "maggic/color_batch.hpp"

namespace maggic::hue_pivots {

inline constexpr int kHues = 256;

inline std::uint8_t largest(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  return std::max(std::max(b, g), r);
}
inline std::uint8_t smallest(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  return std::min(std::min(b, g), r);
}
inline int spread_of(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  return largest(b, g, r) - smallest(b, g, r);
}

// OpenCV's 8-bit conversion takes the hue as sector · spread + difference of two channels, an
// integer in [-spread, 5·spread], scaled by a table of rounded 1/spread. So the hue is a function
// of that numerator and the spread, and one table of all such pairs answers it: row `spread` has
// 6·spread + 1 entries.
constexpr std::uint32_t hue_index(std::uint32_t spread, std::int32_t numerator) {
  return 3 * spread * spread - spread + static_cast<std::uint32_t>(numerator);
}

/// Where in the table the hue of a colour stands; of a gray, hue_index(0, 0).
inline std::uint32_t hue_index_of(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  const std::uint8_t value = largest(b, g, r);
  const auto spread = static_cast<std::int16_t>(value - smallest(b, g, r));
  const auto of_red = static_cast<std::int16_t>(g - b);
  const auto of_green = static_cast<std::int16_t>(b - r + 2 * spread);
  const auto of_blue = static_cast<std::int16_t>(r - g + 4 * spread);
  const std::int16_t below_red = value == g ? of_green : of_blue;
  const std::int16_t numerator = value == r ? of_red : below_red;
  return hue_index(static_cast<std::uint32_t>(spread), numerator);
}

/// The same of many colours. @param indices as many as there are colours.
void hue_indices(const ColorBatch& colors, std::uint32_t* indices);

/// The hue at every hue_index.
std::vector<std::uint8_t> opencv_hues();

/// 255 / value in units of 1/4096, by value.
std::array<std::int32_t, 256> opencv_saturation_scales();

/// Saturation of a colour of this spread. @param scale of its value.
inline std::uint8_t scaled_spread(int spread, std::int32_t scale) {
  return static_cast<std::uint8_t>((spread * scale + (1 << 11)) >> 12);
}

}  // namespace maggic::hue_pivots
