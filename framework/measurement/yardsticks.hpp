#pragma once
/// What the frame path is measured against: the least any method has to do, and the plain way.

#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/color_table.hpp"

namespace maggic {

/// Reads every byte of a picture and writes a byte a pixel, with the machine's widest vector
/// instructions on one thread: each pixel's three channels joined by bitwise or, which asks nothing
/// of the data, written past the caches. No method that looks at all pixels and labels them can be
/// faster from memory.
/// @param bgr CV_8UC3. @param ors set to CV_8UC1 of its size.
void join_channels(const cv::Mat& bgr, cv::Mat& ors);

/// The labels of all 2^24 colours of `table` in a row, blue changing fastest, then green.
std::vector<Label> flat_labels(const ColorTable& table);

/// Asks a flat table once a pixel: the look-up that a colour table stands for, without any art.
/// @param bgr CV_8UC3. @param flat as `flat_labels` makes it. @param labels set to CV_8UC1.
void look_up_each_pixel(const cv::Mat& bgr, const std::vector<Label>& flat, cv::Mat& labels);

}  // namespace maggic
