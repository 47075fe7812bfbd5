#pragma once
/// What the stages make of a picture, to look at.

#include <cstddef>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "maggic/document.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/palette.hpp"
#include "maggic/plugin_registry.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// The picture as a normalizer makes it.
/// @param bgr CV_8UC3, at least 1×1. @return CV_8UC3 of the same size.
/// @throws std::exception what the normalizer throws, or when it makes what it must not.
cv::Mat normalized_picture(const cv::Mat& bgr, Normalizer& normalizer);

/// The label of every pixel, without a table for all colours.
/// @param bgr CV_8UC3, at least 1×1. @return CV_8UC1 of the same size, labels below `palette_size`.
/// @throws std::exception what a stage throws, or when it makes what it must not.
cv::Mat label_picture(const cv::Mat& bgr, Normalizer& normalizer, Segmenter& segmenter,
                      std::size_t palette_size);

/// Every label in its palette colour on black: CV_8UC3.
/// @param labels CV_8UC1, every label below the palette's size.
cv::Mat colored_labels(const cv::Mat& labels, const Palette& palette);

/// A segmenter like the one a pipeline has, with another gray threshold.
/// @param section the pipeline's `segmenter` section: a map from the plugin's name to its
///   parameters, without mistakes.
/// @return null when the plugin has no whole-number parameter `gray_threshold`, or when it is off:
///   not set, and by default `none`.
/// @throws ConfigError when the plugin refuses the threshold, PluginError when it does not load.
StagePtr<Segmenter> segmenter_with_threshold(const Node& section, int gray_threshold,
                                             PluginRegistry& registry, const StageContext& context);

}  // namespace maggic
