#pragma once
/// Which label covers the centre of every pixel.

#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/palette.hpp"

namespace maggic::synthetic_match {

/// CV_8UC1. A pixel belongs to a shape when its centre does; one on an edge shared by two shapes
/// belongs to exactly one of them.
class LabelPicture {
 public:
  explicit LabelPicture(cv::Size picture);

  void clear();
  /// Paints over what was there. @param contour_px a closed polygon; even-odd rule.
  void paint(std::span<const cv::Point2d> contour_px, Label label);

  const cv::Mat& labels() const { return labels_; }

 private:
  cv::Mat labels_;
  std::vector<double> crossings_;
};

}  // namespace maggic::synthetic_match
