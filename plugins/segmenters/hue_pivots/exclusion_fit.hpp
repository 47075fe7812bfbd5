#pragma once
/// Rectangles to be left out: what looks like a tag's colour, and is none.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "maggic/palette.hpp"

namespace maggic::hue_pivots {

/// A colour by OpenCV's HSV_FULL.
struct Hsv {
  std::uint8_t hue = 0;
  std::uint8_t saturation = 0;
  std::uint8_t value = 0;
};

/// Values first … last, both included; a span of hues may run through 255 to 0.
struct Span {
  int first = 0;
  int last = 255;
};

struct FittedExclusion {
  Span hue;
  Span value;          ///< 0 … 255: any.
  Span saturation;     ///< 0 … 255: any.
  double share = 0.0;  ///< Of the pixels that are no tag and would have been taken for one.
};

struct ExclusionFit {
  std::vector<FittedExclusion> exclusions;
  double left_over = 0.0;  ///< Share of such pixels that nothing tells from a tag.
};

/// For every hue whether tags have it, or one within `reach` of it. A few stray pixels do not
/// count.
std::array<bool, 256> hues_near(std::span<const Hsv> tags, int reach);

/// Leaves out hues no tag has; where hues are shared, what is clearly darker, brighter, paler or
/// stronger than every tag of that hue.
/// @param tags pixels of tags. @param others pixels that would be labelled, and are no tag.
ExclusionFit fit_exclusions(std::span<const Hsv> tags, std::span<const Hsv> others);

}  // namespace maggic::hue_pivots
