#pragma once
/// Spans of hues, and of other 8-bit values.

#include <cstdint>

namespace maggic::hue_pivots {

/// The values from `first` on, `steps` further ones, through 255 to 0. All of them at first.
struct CircularSpan {
  std::uint8_t first = 0;
  std::uint8_t steps = 255;

  /// Both included; modulo 256.
  static CircularSpan from_to(int first, int last) {
    return {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(last - first)};
  }

  bool holds(std::uint8_t value) const { return steps_to(value) <= steps; }
  bool holds(const CircularSpan& other) const {
    return steps == 255 || steps_to(other.first) + other.steps <= steps;
  }
  bool meets(const CircularSpan& other) const { return holds(other.first) || other.holds(first); }

 private:
  std::uint8_t steps_to(std::uint8_t value) const {
    return static_cast<std::uint8_t>(value - first);
  }
};

}  // namespace maggic::hue_pivots
