#pragma once
/// A normalizer as a picture: where it moves colours to (MaggicVision monograph, figures 13 and
/// 18–20).

#include <string_view>

#include "maggic/normalizer.hpp"
#include "maggic/svg_plot.hpp"

namespace maggic {

/// Arrows from original to normalised colours, in the original's colour, over four sections of the
/// RGB cube: the red–green plane at blue 0 and at blue 64, hue against value at 60 % saturation,
/// and hue against saturation at value 200. Each arrow is seen in the section's own two
/// coordinates; a colour that does not move there is a dot. Hue is in 1/256 of the circle, as
/// everywhere in Maggic; one that becomes gray keeps its hue, having none.
/// @param name of the normalizer, for the title.
PlotGrid normalizer_plot(std::string_view name, const ColorNormalizer& normalizer);

}  // namespace maggic
