#include "calibration/chroma_frame.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "pipeline/image_path.hpp"

namespace maggic::calibration {
namespace {

constexpr int kMedianSidePx = 3;

cv::Mat channel_spread(const cv::Mat& colors) {
  cv::Mat spread(colors.size(), CV_8UC1);
  for (int y = 0; y < colors.rows; ++y) {
    const cv::Vec3b* in = colors.ptr<cv::Vec3b>(y);
    std::uint8_t* out = spread.ptr<std::uint8_t>(y);
    for (int x = 0; x < colors.cols; ++x) {
      const auto [low, high] = std::minmax({in[x][0], in[x][1], in[x][2]});
      out[x] = static_cast<std::uint8_t>(high - low);
    }
  }
  return spread;
}

cv::Mat normalized_picture(const cv::Mat& bgr, Normalizer& normalizer) {
  ImagePath path;
  path.normalize(bgr, normalizer);
  return path.normalized();
}

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

int hue_of(cv::Vec3b bgr) {
  cv::Mat hsv;
  cv::cvtColor(cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2])), hsv,
               cv::COLOR_BGR2HSV_FULL);
  return hsv.at<cv::Vec3b>(0, 0)[0];
}

double hue_difference(double to, double from) {
  const double turned = std::fmod(to - from + 128.0, 256.0);
  return (turned < 0.0 ? turned + 256.0 : turned) - 128.0;
}

}  // namespace maggic::calibration
