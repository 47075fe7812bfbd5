#pragma once
/// Pictures that say what every pixel of another picture shows.

#include <opencv2/core/mat.hpp>

#include "maggic/palette.hpp"

namespace maggic {

/// Reads a picture of labels. Two ways of writing them are understood:
/// - one channel of 8 bit: the gray value is the palette's label;
/// - three or four channels of 8 bit (B G R, a fourth one is not looked at): every pixel has the
///   display colour of a palette colour, black being background.
/// @return CV_8UC1 of the same size, every label below the palette's size.
/// @throws std::invalid_argument saying what was found where, for anything else.
cv::Mat labels_of(const cv::Mat& picture, const Palette& palette);

}  // namespace maggic
