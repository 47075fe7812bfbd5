#pragma once
/// What the methods judge a picture's colours by.

#include <opencv2/core/mat.hpp>

namespace maggic {

/// Largest minus smallest channel, what a gray threshold looks at: CV_8UC1.
/// @param colors CV_8UC3.
cv::Mat channel_spread(const cv::Mat& colors);

/// Hue, saturation and value of a colour as OpenCV's HSV_FULL has them, each 0 … 255; the hue of a
/// gray is 0.
cv::Vec3b hsv_of(cv::Vec3b bgr);
int hue_of(cv::Vec3b bgr);

}  // namespace maggic
