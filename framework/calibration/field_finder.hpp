#pragma once
/// Where the field lies in the picture, by its lines and walls.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "calibration/tag_metric.hpp"
#include "maggic/field.hpp"

namespace maggic::calibration {

struct FoundField {
  std::array<cv::Point2d, 4> corners_px;  ///< Top-left, top-right, bottom-right, bottom-left.
  double lens_k1 = 0.0;                   ///< 0: straight lines are straight.
  double error_px = 0.0;           ///< RMS distance of the lines seen from where they should be.
  double seen_share = 0.0;         ///< Of the length of all lines of the model, by weight.
  std::vector<std::string> lines;  ///< Names of the lines seen.
};

/// Matches the lines of the field's format against the bright lines of the picture, with the size
/// the tags suggest as a start; then moves corners and lens until they fit best.
/// @param picture CV_8UC3, best a mean of many frames. @param field its format and camera.
/// @return nothing when too little was recognised to be sure.
std::optional<FoundField> find_field(const cv::Mat& picture, const FieldParameters& field,
                                     const TagMetric& metric);

}  // namespace maggic::calibration
