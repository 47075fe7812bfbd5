#pragma once
/// The calibration file: a partial pipeline with a comment on every number.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

namespace maggic::calibration {

/// Corners and lens with what is to be said about them.
struct FieldNumbers {
  std::array<cv::Point2d, 4> corners_px;  ///< Top-left, top-right, bottom-right, bottom-left.
  std::string corners_comment;
  cv::Size image_size_px;
  double lens_k1 = 0.0;
  double lens_k2 = 0.0;
  std::string lens_comment;
};

struct BlobNumbers {
  double min_area_mm2 = 0.0;
  std::string min_comment;
  double max_area_mm2 = 0.0;
  std::string max_comment;
};

struct LightNumbers {
  bool follow = true;
  std::array<double, 3> reference_rgb{};
};

struct CalibrationNumbers {
  std::vector<std::string> heading;  ///< Comment lines on top.
  std::string segmenter;             ///< Plugin name.
  std::string segmenter_yaml;        ///< Its parameters, not indented.
  std::optional<FieldNumbers> field;
  std::optional<BlobNumbers> blobs;
  std::optional<LightNumbers> light;
};

std::string to_calibration_yaml(const CalibrationNumbers& numbers);

}  // namespace maggic::calibration
