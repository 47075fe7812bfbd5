#pragma once
/// What can be wrong with four corners.

#include <span>
#include <string>

#include <opencv2/core/types.hpp>

namespace maggic {

/// One sentence on what is wrong with the corners of a field and what was expected; empty when
/// they are top-left, top-right, bottom-right, bottom-left of a convex quadrilateral (y down).
std::string mistake_in_corners(std::span<const cv::Point2d> corners);

}  // namespace maggic
