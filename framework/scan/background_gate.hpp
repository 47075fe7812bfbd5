#pragma once
/// Telling most background by two comparisons, without asking the table.

#include <array>
#include <cstdint>

#include "maggic/color_table.hpp"

namespace maggic {

/// Read off a compiled table, whatever made it: for each sixteenth of the value (the largest
/// channel) the smallest spread (largest minus smallest channel) at which any colour has a label.
/// A pixel below that is background; nothing is said of the others. Colourless pixels are most of
/// every field, and nearly every method takes them for background.
class BackgroundGate {
 public:
  explicit BackgroundGate(const ColorTable& table);

  /// By value / 16; 255 where no colour of that value has a label (a spread of 255 is let through
  /// all the same).
  const std::array<std::uint8_t, 16>& first_colored_spread() const { return first_; }

  /// Whether it lets less through than all.
  bool helps() const;

 private:
  alignas(16) std::array<std::uint8_t, 16> first_;
};

}  // namespace maggic
