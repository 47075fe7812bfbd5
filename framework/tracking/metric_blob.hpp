#pragma once
/// Blobs in millimetres: what the matcher works on.

#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/blob.hpp"
#include "maggic/field.hpp"

namespace maggic::tracking {

/// A blob, or half of one, seen as a patch at a certain height above the floor.
struct MetricBlob {
  int source = 0;  ///< Index into the frame's blobs.
  Label label = kBackground;
  cv::Point2d position_mm;
  double area_mm2 = 0.0;
  double major_mm2 = 0.0;  ///< Variance along the longest axis …
  double minor_mm2 = 0.0;  ///< … and across it; above 0.
  double axis_rad = 0.0;   ///< Direction of the longest axis; only the line counts.

  /// What the blob takes of its source: bit 0 the first half, bit 1 the second. Two blobs of one
  /// source exclude each other when they have a bit in common.
  unsigned parts = 3;
  bool is_half() const { return parts != 3; }

  /// Length over width, at least 1.
  double elongation() const;
  /// Area over that of an ellipse with the same moments: 1 for an ellipse, 0.95 for a rectangle,
  /// much less for something branched or hollow.
  double fill() const;
};

MetricBlob to_metric(const Blob& blob, int source, const Field& field, double height_mm);

/// Bounds of the blob area, in pixels, that can show something of `min_mm2` … `max_mm2`: a quick
/// sieve, generous by a half to either side.
struct AreaSieve {
  double min_px = 0.0;
  double max_px = 0.0;
  AreaSieve(const Field& field, double height_mm, double min_mm2, double max_mm2);
  bool passes(const Blob& blob) const { return blob.area_px >= min_px && blob.area_px <= max_px; }
};

/// Two equal patches that run into each other make one blob. Finds where their centres are from
/// the blob's second moments: the sum of both variances is that of one patch plus the squared
/// half distance of the centres, however the patches are turned.
/// @param patch_variance_mm2 sum of one patch's variances along its axes.
/// @return false when the blob is too round to say in which direction the halves lie.
bool split_in_two(const MetricBlob& blob, double patch_variance_mm2, MetricBlob& first,
                  MetricBlob& second);

}  // namespace maggic::tracking
