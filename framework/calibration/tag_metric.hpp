#pragma once
/// How large the picture's pixels are on the field, as the tags themselves tell.

#include <span>

#include <opencv2/core/types.hpp>

namespace maggic::calibration {

/// Offsets in the picture to millimetres: |offset_mm|² = offsetᵀ · mm2_per_px2 · offset. Diagonal
/// and positive: pixels may be stretched (a camera's picture brought to 16:9), but are never
/// skewed.
struct TagMetric {
  cv::Matx22d mm2_per_px2{1.0, 0.0, 0.0, 1.0};

  static TagMetric of_scale(double mm_per_px);

  double length_mm(cv::Point2d offset_px) const;
  /// Area of one pixel.
  double pixel_mm2() const;
  /// The same as a linear map of offsets to millimetres.
  cv::Matx22d mm_per_px() const;
};

/// Two points of one tag and how far apart they are on it.
struct KnownDistance {
  cv::Point2d offset_px;
  double distance_mm = 0.0;
};

/// Least-squares metric over known distances, drawn towards the nearest isotropic one where they
/// point in too few directions to tell a stretch.
/// @param distances at least one, offsets not zero.
TagMetric fit_metric(std::span<const KnownDistance> distances);

}  // namespace maggic::calibration
