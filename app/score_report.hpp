#pragma once
/// A score as a person reads it.

#include <string>
#include <vector>

#include "maggic/palette.hpp"
#include "maggic/score_figures.hpp"
#include "maggic/scorecard.hpp"

namespace maggic::app {

/// Every robot, all robots together and the ball, a line each.
std::string objects_text(const Scorecard& card, const Palette& palette);

/// What is not an object's: false ones, swaps, corners, and times of the steps.
/// @param figures of the whole run, see score_figures.
std::string rest_text(const std::vector<Figure>& figures);

/// "2.5 px".
std::string tolerance_text(Tolerance tolerance);

}  // namespace maggic::app
