#pragma once
/// Colours of which calibration knows what they are: what a segmenter fits its numbers to.

#include <cstdint>
#include <optional>
#include <span>

#include "maggic/color_batch.hpp"
#include "maggic/palette.hpp"

namespace maggic {

/// Pixels of recognised tags, of the ball and of the background, in no particular order. All spans
/// have one size; valid for the call only.
struct ColorSamples {
  ColorBatch original;
  ColorBatch normalized;
  std::span<const Label> labels;       ///< What each pixel shows; kBackground for what is no tag.
  std::span<const std::int32_t> tags;  ///< Which tag it lies on, from 0; -1 for background.
  const Palette& palette;
  std::optional<int> gray_threshold;   ///< Given by hand: to be kept.
};

}  // namespace maggic
