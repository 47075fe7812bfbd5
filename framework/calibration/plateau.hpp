#pragma once
/// The stretch of a ladder on which something is good and stays so.

#include <cstddef>
#include <span>

namespace maggic::calibration {

/// Steps [first, last] of a ladder, both included.
struct Plateau {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t middle() const { return (first + last + 1) / 2; }
};

/// The stretch of neighbouring steps of about equal worth for which worth times the root of its
/// length is largest: a step that is a little better than a long plateau, but alone, is an
/// accident. Steps without positive worth only count where there is no other.
/// @param worth at least one, finite.
/// @param tolerance share of a step's worth its neighbours may differ by.
Plateau find_plateau(std::span<const double> worth, double tolerance);

}  // namespace maggic::calibration
