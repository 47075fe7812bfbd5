#pragma once
/// Colours of which calibration knows what they are: what a segmenter fits its numbers to.

#include <cstdint>
#include <span>
#include <string>

#include "maggic/color_batch.hpp"
#include "maggic/palette.hpp"

namespace maggic {

/// Where a gray threshold on the spread (largest minus smallest channel) of the normalised colour
/// may lie, 8-bit steps.
struct GrayThreshold {
  int best = 0;
  int lowest = 0;      ///< Below it the background was taken for tags.
  int highest = 255;   ///< Above it a tag was lost.
  bool given = false;  ///< Chosen by hand.
};

/// "12 … 48 finds the same robots", for a comment beside the number.
std::string describe(const GrayThreshold& threshold);

/// Pixels of tags as they would look under other light: nobody has seen them yet, but lamps are
/// switched on and the sun goes down.
struct ImaginedSamples {
  ColorBatch original;
  ColorBatch normalized;
  std::span<const Label> labels;
};

/// `tags` of a pixel of the background.
inline constexpr std::int32_t kNoTag = -1;
/// … and of something else that would be taken for a tag or the ball unless it is left out.
inline constexpr std::int32_t kStrayTag = -2;

/// Pixels of recognised tags, of the ball and of the background, in no particular order. All spans
/// have one size; valid for the call only.
struct ColorSamples {
  ColorBatch original;
  ColorBatch normalized;
  std::span<const Label> labels;       ///< What each pixel shows; kBackground for what is no tag.
  std::span<const std::int32_t> tags;  ///< Which tag it lies on, from 0; else one of those below.
  ImaginedSamples imagined;            ///< Counts only where what was seen leaves a choice.
  const Palette& palette;
  GrayThreshold gray_threshold;
};

}  // namespace maggic
