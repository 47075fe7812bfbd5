/// Broken on purpose: leaves the last column as it was.

#include "maggic/plugin.hpp"

namespace {

class ForgetfulSegmenter final : public maggic::ImageSegmenter {
 public:
  void segment(const cv::Mat& original, const cv::Mat& /*normalized*/, cv::Mat& labels) override {
    labels(cv::Rect(0, 0, original.cols - 1, original.rows)).setTo(0);
  }
};

}  // namespace

MAGGIC_PLUGIN(ForgetfulSegmenter, "does not write every pixel")
