#pragma once
/// Pictures next to each other, each under its title.

#include <span>
#include <string>

#include <opencv2/core/mat.hpp>

namespace maggic {

/// @param pictures CV_8UC3 each, of any sizes; an empty one leaves an empty place as large as the
///   first picture that is not.
/// @param titles as many; what does not fit is cut off.
/// @return CV_8UC3 with tops aligned and a gap between; empty when every picture is.
cv::Mat picture_row(std::span<const cv::Mat> pictures, std::span<const std::string> titles);

}  // namespace maggic
