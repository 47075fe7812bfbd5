#pragma once
/// The contract of a stage that works on pictures, checked for normalizers and segmenters alike.

#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "findings.hpp"

namespace maggic::testing {

/// An image stage seen as a function from pictures to a picture.
struct ImageFunction {
  int inputs = 0;       ///< CV_8UC3 pictures: 1 for a normalizer, 2 for a segmenter.
  int output_type = 0;  ///< CV_8UC3 or CV_8UC1.
  int values = 256;     ///< Every byte written is below this.
  std::function<void(const std::vector<cv::Mat>& in, cv::Mat& out)> run;
};

/// @param first, second two instances of one configuration that have not worked yet.
void check_image_function(const ImageFunction& first, const ImageFunction& second,
                          Findings& findings);

}  // namespace maggic::testing
