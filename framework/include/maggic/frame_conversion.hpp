#pragma once
/// Brings any picture into the one form the frame path takes.

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace maggic {

/// Converts `picture` in place to CV_8UC3 BGR: gray is spread to three channels, alpha dropped,
/// 16-bit scaled by 1/257 (exact for full-range pictures), float taken as 0 … 1. A CV_8UC3
/// picture is left untouched (no copy).
/// @return nothing when the picture is usable, else why not ("it is empty", "it has 2 channels",
///   "70000 × 100 pixels, more than 65535 a side").
std::optional<std::string> convert_to_bgr8(cv::Mat& picture);

}  // namespace maggic
