#pragma once
/// The plots of a comparison.

#include <string>
#include <vector>

#include "maggic/comparison_report.hpp"
#include "maggic/svg_plot.hpp"

namespace maggic {

/// Position error and objects seen against the frame's number, times of the steps: SVG each.
/// Recordings too long to be drawn frame by frame are drawn as means over equal stretches.
std::vector<std::string> comparison_plots(const ComparisonReport& report);

}  // namespace maggic
