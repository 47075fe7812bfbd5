/// Broken on purpose: hands out the picture it keeps, so that the host writes into it.

#include "maggic/plugin.hpp"

namespace {

class HoardingSource final : public maggic::Source {
 public:
  maggic::SourceInfo open() override { return {}; }
  maggic::ReadStatus read(maggic::Frame& frame) override {
    frame.bgr = picture_;
    return maggic::ReadStatus::kFrame;
  }

 private:
  cv::Mat picture_{4, 4, CV_8UC3, cv::Scalar::all(9)};
};

}  // namespace

MAGGIC_PLUGIN(HoardingSource, "keeps a reference to the host's picture")
