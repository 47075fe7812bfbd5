#include "maggic/picture_colors.hpp"

#include <algorithm>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace maggic {

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

cv::Vec3b hsv_of(cv::Vec3b bgr) {
  cv::Mat3b hsv;
  cv::cvtColor(cv::Mat3b(1, 1, bgr), hsv, cv::COLOR_BGR2HSV_FULL);
  return hsv(0, 0);
}

int hue_of(cv::Vec3b bgr) { return hsv_of(bgr)[0]; }

}  // namespace maggic
