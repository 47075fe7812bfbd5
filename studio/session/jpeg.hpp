#pragma once
/// Pictures as JPEG.

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace maggic::studio {

/// Baseline JPEG with colours at half the resolution, as cameras give it.
/// @param bgr CV_8UC3, 1×1 to 65500×65500. @throws std::runtime_error beyond that.
std::vector<std::uint8_t> jpeg_of(const cv::Mat& bgr);

}  // namespace maggic::studio
