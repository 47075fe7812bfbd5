#pragma once
/// What a sweep of gray thresholds says, as plots and as a table.

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/label_sweep.hpp"
#include "maggic/palette.hpp"
#include "maggic/svg_plot.hpp"

namespace maggic {

struct NamedSweep {
  std::string normalizer;
  LabelSweep sweep;
};

/// Share of every label's pixels against the gray threshold, a line each; the usable thresholds
/// (every label at `share`, 0 … 1, or above) are shaded.
LinePlot plot_of(const NamedSweep& sweep, const Palette& palette, double share, cv::Size size_px);

/// One row for each normalizer and threshold: normalizer, gray_threshold, then the percentage of
/// every label the pictures have.
std::string csv_of(const std::vector<NamedSweep>& sweeps, const Palette& palette);

}  // namespace maggic
