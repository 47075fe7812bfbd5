#include "studio/session/hue_plane.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace maggic::studio {
namespace {

constexpr int kHues = 256;
constexpr int kHalf = 128;

// From 255 in the first row of a half to 0 in its last.
std::uint8_t falling(int row) {
  return static_cast<std::uint8_t>(255 * (kHalf - 1 - row) / (kHalf - 1));
}

cv::Mat logarithmic(const cv::Mat& counts) {
  double most = 0.0;
  cv::minMaxLoc(counts, nullptr, &most);
  cv::Mat scaled;
  cv::log(counts + 1.0f, scaled);
  cv::Mat out;
  const double scale = most > 0.0 ? 255.0 / std::log(most + 1.0) : 0.0;
  scaled.convertTo(out, CV_8UC1, scale);
  return out;
}

}  // namespace

cv::Mat plane_labels(const ColorTable& table) {
  cv::Mat hsv(2 * kHalf, kHues, CV_8UC3);
  for (int row = 0; row < hsv.rows; ++row) {
    const bool is_upper = row < kHalf;
    const std::uint8_t level = falling(row % kHalf);
    for (int hue = 0; hue < kHues; ++hue) {
      hsv.at<cv::Vec3b>(row, hue) = is_upper
                                        ? cv::Vec3b(static_cast<std::uint8_t>(hue), 255, level)
                                        : cv::Vec3b(static_cast<std::uint8_t>(hue), level, 255);
    }
  }
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR_FULL);
  cv::Mat labels(hsv.size(), CV_8UC1);
  for (int row = 0; row < bgr.rows; ++row) {
    for (int hue = 0; hue < kHues; ++hue) {
      const auto& color = bgr.at<cv::Vec3b>(row, hue);
      labels.at<Label>(row, hue) = table(color[0], color[1], color[2]);
    }
  }
  return labels;
}

HueDensity hue_density(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV_FULL);
  cv::Mat by_value(kHalf, kHues, CV_32FC1, cv::Scalar(0));
  cv::Mat by_saturation = by_value.clone();
  const auto row_of = [](int level) { return (255 - level) * (kHalf - 1) / 255; };
  for (int y = 0; y < hsv.rows; ++y) {
    for (int x = 0; x < hsv.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const auto& color = hsv.at<cv::Vec3b>(y, x);
      by_value.at<float>(row_of(color[2]), color[0]) += 1.0f;
      by_saturation.at<float>(row_of(color[1]), color[0]) += 1.0f;
    }
  }
  return {logarithmic(by_value), logarithmic(by_saturation)};
}

}  // namespace maggic::studio
