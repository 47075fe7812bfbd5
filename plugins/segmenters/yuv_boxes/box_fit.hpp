#pragma once
/// YUV boxes from colours of which it is known what they are.

#include <array>
#include <span>
#include <vector>

#include "maggic/color_samples.hpp"

namespace maggic::yuv_boxes {

/// A colour in Y, U, V.
using Yuv = std::array<std::uint8_t, 3>;

/// Smallest and largest value of a channel, both included.
struct Side {
  int min = 255;
  int max = 0;
};

struct FittedBox {
  Label label = kBackground;
  int tags = 0;              ///< Tags it was seen on.
  std::array<Side, 3> seen;  ///< Middle 96 % of its pixels in Y, U, V.
  std::array<Side, 3> box;   ///< As much of that, and of the room round it, as is nothing else's.
  double foreign = 0.0;      ///< Share of the pixels in the box that are another colour's.
};

/// Boxes in the order of the labels. Each starts as the heart of its colour and grows, side by
/// side, as long as it takes in hardly a pixel of another colour or of the background.
/// @param colors,labels,tags one each a sample, as in ColorSamples.
std::vector<FittedBox> fit_boxes(std::span<const Yuv> colors, std::span<const Label> labels,
                                 std::span<const std::int32_t> tags);

/// Whether the box holds the colour.
bool holds(const std::array<Side, 3>& box, const Yuv& color);

}  // namespace maggic::yuv_boxes
