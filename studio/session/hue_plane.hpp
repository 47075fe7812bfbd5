#pragma once
/// The plane of hue against value and saturation: what the table makes of it, and where a frame's
/// pixels lie on it. Source: MaggicVision, the detailed interface (figure 41).

#include <opencv2/core/mat.hpp>

#include "maggic/color_table.hpp"

namespace maggic::studio {

/// The label of each colour of the plane: CV_8UC1, 256 × 256. Hue, as HSV_FULL has it, from left to
/// right; in the upper half value falls from 255 at saturation 255, in the lower half saturation
/// does at value 255.
cv::Mat plane_labels(const ColorTable& table);

/// How many of a picture's colours lie where, the logarithm, 0 for none and 255 for the most:
/// CV_8UC1, 128 rows from 255 down by 256 hues.
struct HueDensity {
  cv::Mat by_value;
  cv::Mat by_saturation;
};

/// @param bgr CV_8UC3, the colours whose hue is taken.
/// @param mask CV_8UC1 of the same size: those that count are not 0.
HueDensity hue_density(const cv::Mat& bgr, const cv::Mat& mask);

}  // namespace maggic::studio
