/// Broken on purpose: time runs backwards, the end is not the end, and every opening is another.

#include <atomic>

#include "maggic/plugin.hpp"

namespace {

std::atomic<int> openings{0};

class RestlessSource final : public maggic::Source {
 public:
  maggic::SourceInfo open() override {
    shade_ = ++openings;
    return {};
  }
  maggic::ReadStatus read(maggic::Frame& frame) override {
    if (++reads_ == 5) return maggic::ReadStatus::kEnd;
    frame.bgr = cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(shade_));
    frame.captured = std::chrono::milliseconds(-reads_);
    return maggic::ReadStatus::kFrame;
  }

 private:
  int shade_ = 0;
  int reads_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(RestlessSource, "breaks every promise of a source")
