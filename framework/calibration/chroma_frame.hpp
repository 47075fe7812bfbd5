#pragma once
/// A frame as calibration looks at it.

#include <opencv2/core/mat.hpp>

#include "maggic/normalizer.hpp"

namespace maggic::calibration {

/// One picture with what the segmentation methods judge it by. All of one size.
struct ChromaFrame {
  cv::Mat bgr;         ///< CV_8UC3.
  cv::Mat normalized;  ///< CV_8UC3: the pipeline's normalizer over `bgr`.
  /// CV_8UC1, of the picture after a 3 × 3 median, which takes noise off without moving edges:
  cv::Mat spread;  ///< Largest minus smallest normalised channel: what a gray threshold looks at.
  cv::Mat hue;     ///< Of the original colour, OpenCV's HSV_FULL, 0 … 255.
};

/// @param bgr CV_8UC3, at least 1×1; kept, not copied.
/// @throws what an ImageNormalizer throws.
ChromaFrame make_chroma_frame(const cv::Mat& bgr, Normalizer& normalizer);

/// Shortest way round the hue circle from `from` to `to`, in [-128, 128).
double hue_difference(double to, double from);

}  // namespace maggic::calibration
