#include "calibration/chroma_frame.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "maggic/label_picture.hpp"
#include "maggic/picture_colors.hpp"

namespace maggic::calibration {
namespace {

constexpr int kMedianSidePx = 3;

}  // namespace

ChromaFrame make_chroma_frame(const cv::Mat& bgr, Normalizer& normalizer) {
  ChromaFrame frame;
  frame.bgr = bgr;
  frame.normalized = normalized_picture(bgr, normalizer);
  cv::Mat calm;
  cv::medianBlur(bgr, calm, kMedianSidePx);
  frame.spread = channel_spread(normalized_picture(calm, normalizer));
  cv::Mat hsv;
  cv::cvtColor(calm, hsv, cv::COLOR_BGR2HSV_FULL);
  cv::extractChannel(hsv, frame.hue, 0);
  return frame;
}

double hue_difference(double to, double from) {
  const double turned = std::fmod(to - from + 128.0, 256.0);
  return (turned < 0.0 ? turned + 256.0 : turned) - 128.0;
}

}  // namespace maggic::calibration
