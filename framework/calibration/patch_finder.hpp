#pragma once
/// Regions of one hue that may be tag patches or the ball, found without knowing any colour.

#include <vector>

#include <opencv2/core/types.hpp>

#include "calibration/chroma_frame.hpp"

namespace maggic::calibration {

/// A compact region of one hue.
struct Patch {
  cv::Point2d centroid_px;
  double area_px = 0.0;
  cv::Matx22d moments_px2;  ///< Central second moments.
  double hue = 0.0;         ///< Median round the circle, [0, 256).
  double hue_deviation = 0.0;
  int median_spread = 0;
  int companions = 0;  ///< Other patches in the same region of colour.
  std::vector<cv::Point> pixels;

  /// Length over width of the ellipse with the same moments, at least 1.
  double elongation() const;
};

/// Regions whose spread exceeds a threshold, cut where the hue changes.
///
/// Within each connected region the hues of its own pixels are clustered, so that noise and light
/// that changes over the field do not matter; regions far from the size of a robot are passed over.
/// @param gray_threshold 0 … 255; pixels whose spread is above it are looked at.
std::vector<Patch> find_patches(const ChromaFrame& frame, int gray_threshold);

}  // namespace maggic::calibration
