#pragma once
/// From pixels to runs: the part of the frame path that touches every pixel.

#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/blob.hpp"
#include "maggic/color_table.hpp"
#include "maggic/light_follower.hpp"

namespace maggic {

/// Fills `runs`, whatever it held before, with every maximal run of equal non-background label, by
/// rows and then by columns, both ascending.
/// @param bgr CV_8UC3, at most 65535 a side, rows may be padded.
void extract_runs(const cv::Mat& bgr, const ColorTable& table, std::vector<Run>& runs);

/// The same of colours that are first sent through `map`, channel by channel.
void extract_runs(const cv::Mat& bgr, const ColorTable& table, const ChannelMap& map,
                  std::vector<Run>& runs);

/// The same from a label image, for segmenters that need the picture.
/// @param labels CV_8UC1, at most 65535 a side.
void extract_runs(const cv::Mat& labels, std::vector<Run>& runs);

/// Writes the label image that `runs` describe, for sinks and views that want to see it.
/// @param labels set to CV_8UC1 of `size`.
void draw_runs(const std::vector<Run>& runs, cv::Size size, cv::Mat& labels);

}  // namespace maggic
