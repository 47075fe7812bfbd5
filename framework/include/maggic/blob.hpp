#pragma once
/// Runs of equal label along a row, and the connected regions (blobs) they form.

#include <cstdint>

#include <opencv2/core/types.hpp>

#include "maggic/palette.hpp"

namespace maggic {

/// A horizontal stretch of pixels of one label, never background: row `row`, columns
/// [begin, end). 8 bytes, so a frame's runs stay in cache; hence frames up to 65535 a side.
struct Run {
  std::uint16_t row = 0;
  std::uint16_t begin = 0;
  std::uint16_t end = 0;  ///< One past the last column.
  Label label = kBackground;
  friend bool operator==(const Run&, const Run&) = default;
};

/// A maximal 8-connected region of one label.
struct Blob {
  Label label = kBackground;
  std::int32_t area_px = 0;      ///< Number of pixels.
  cv::Point2d centroid_px;       ///< Mean of the pixel centres: sub-pixel.
  cv::Rect bounds_px;            ///< Smallest box that holds every pixel.
  double moment_xx_px2 = 0.0;    ///< Central second moments: mean of (x-cx)^2, …; each pixel is a
  double moment_yy_px2 = 0.0;    ///< unit square, so 1/12 is added to xx and yy and a w×h box
  double moment_xy_px2 = 0.0;    ///< reads exactly w²/12 and h²/12.
};

}  // namespace maggic
