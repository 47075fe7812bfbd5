#include "label_picture.hpp"

#include <algorithm>
#include <cmath>

namespace maggic::synthetic_match {

LabelPicture::LabelPicture(cv::Size picture) : labels_(cv::Mat::zeros(picture, CV_8UC1)) {}

void LabelPicture::clear() { labels_.setTo(kBackground); }

void LabelPicture::paint(std::span<const cv::Point2d> contour_px, Label label) {
  const auto [low, high] = std::ranges::minmax(contour_px, {}, &cv::Point2d::y);
  const auto pixel = [](double v, int end) {
    return static_cast<int>(std::ceil(std::clamp(v, 0.0, static_cast<double>(end))));
  };
  for (int y = pixel(low.y, labels_.rows); y < pixel(high.y, labels_.rows); ++y) {
    crossings_.clear();
    for (std::size_t i = 0; i < contour_px.size(); ++i) {
      const cv::Point2d a = contour_px[i];
      const cv::Point2d b = contour_px[(i + 1) % contour_px.size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      crossings_.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    std::ranges::sort(crossings_);
    Label* row = labels_.ptr<Label>(y);
    for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
      std::fill(row + pixel(crossings_[i], labels_.cols),
                row + pixel(crossings_[i + 1], labels_.cols), label);
    }
  }
}

}  // namespace maggic::synthetic_match
