#pragma once
/// One picture on its way from the source to the sinks.

#include <chrono>
#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "maggic/detections.hpp"

namespace maggic {

/// A moment in nanoseconds. Live sources count from the Unix epoch; recorded ones from their first
/// frame. Only differences matter to trackers; the network sinks need the Unix epoch.
using Timestamp = std::chrono::nanoseconds;

/// One captured picture.
///
/// Pixel coordinates everywhere in Maggic are OpenCV's: (0,0) is the *centre* of the top-left
/// pixel, x to the right, y down.
struct Frame {
  std::uint64_t sequence = 0;  ///< 0, 1, 2, … as captured; gaps are frames that were dropped.
  Timestamp captured{0};       ///< When the light was taken, as exactly as the source knows.
  cv::Mat bgr;                 ///< CV_8UC3, B G R order; rows may be padded (not continuous).

  bool has_truth = false;  ///< True when the source knows what is really in the picture.
  Detections truth;        ///< Exact ground truth; meaningful only when `has_truth`.

  /// What really covers the centre of every pixel: CV_8UC1 of the picture's size, a label of the
  /// pipeline's palette each, kBackground for all that is neither tag nor ball. Empty when unknown,
  /// which is how the host hands the frame to a source.
  cv::Mat truth_labels;
};

}  // namespace maggic
