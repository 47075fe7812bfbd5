#pragma once
/// The region a pixel belongs to.

#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/blob.hpp"

namespace maggic {

/// The runs of the 8-connected region of one label that holds `pixel_px`, ordered as `runs` is;
/// empty when the pixel is background.
/// @param runs as RunScanner leaves them.
std::vector<Run> connected_runs(std::span<const Run> runs, cv::Point pixel_px);

/// The run that holds `pixel_px`; null when it is background.
const Run* run_at(std::span<const Run> runs, cv::Point pixel_px);

}  // namespace maggic
