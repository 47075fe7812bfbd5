#pragma once
/// Pivots from colours of which it is known what they are.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "maggic/color_samples.hpp"

namespace maggic::hue_pivots {

/// Hues of each colour, in the order in which ties are broken.
using Pivots = std::vector<std::pair<Label, std::vector<int>>>;

/// The label of the nearest pivot for every hue, around the circle; ties go to the first listed.
std::array<Label, 256> nearest_pivots(const Pivots& pivots);

/// What was learnt about one colour.
struct FittedColor {
  Label label = kBackground;
  std::vector<int> pivots;  ///< Empty: not seen, and in the way of colours that were.
  int tags = 0;             ///< Tags it was seen on; 0: not seen.
  int first_hue = 0;        ///< Middle 96 % of its pixels, in the order of the circle.
  int last_hue = 0;
  /// How far its pivots can be moved together, in either direction, until some tag loses half of
  /// its pixels.
  int move_down = 0;
  int move_up = 0;
};

/// Two colours that no border parts.
struct Overlap {
  Label a = kBackground;
  Label b = kBackground;
  double share = 0.0;  ///< Of the pixels of the colour that suffers more.
};

struct PivotFit {
  std::vector<FittedColor> colors;  ///< In the order of `known`, then those only seen, by label.
  std::vector<Overlap> overlaps;    ///< Share above 3 %.
};

/// Hues of tags under light not seen yet; see ImaginedSamples.
struct ImaginedHues {
  std::span<const std::uint8_t> hues;
  std::span<const Label> labels;
};

/// Places borders in the emptiest stretch of hue between neighbouring colours, and within it where
/// other light costs least; then pivots so that the borders are half-way between them: one pivot a
/// colour where that is possible, more where it is not.
/// @param hues one a sample. @param labels,tags as in ColorSamples.
/// @param known pivots so far: kept for colours that were not seen, unless they would take hues of
///   those that were.
PivotFit fit_pivots(std::span<const std::uint8_t> hues, std::span<const Label> labels,
                    std::span<const std::int32_t> tags, const ImaginedHues& imagined,
                    const Pivots& known);

}  // namespace maggic::hue_pivots
