#pragma once
/// Pictures as PNG, without OpenCV's codecs: loading those takes longer than most commands run.

#include <string>

#include <opencv2/core/mat.hpp>

namespace maggic {

/// @param bgr CV_8UC3, at least 1×1, rows may be padded.
/// @return the bytes of a PNG file (8-bit RGB). The same picture gives the same bytes.
/// @throws std::invalid_argument for another type or an empty picture.
std::string png_bytes(const cv::Mat& bgr);

}  // namespace maggic
