#include "coverage.hpp"

namespace maggic::synthetic_match {

Coverage::Coverage(cv::Size picture)
    : picture_(picture),
      stride_(static_cast<std::size_t>(picture.width) + 2),
      cells_(stride_ * static_cast<std::size_t>(picture.height), 0.0f) {}

void Coverage::add_contour(std::span<const cv::Point2d> contour_px) {
  const cv::Point2d half(0.5, 0.5);
  constexpr double kFar = std::numeric_limits<double>::max();
  cv::Point2d low(kFar, kFar);
  cv::Point2d high(-kFar, -kFar);
  for (std::size_t i = 0; i < contour_px.size(); ++i) {
    const cv::Point2d from = contour_px[i] + half;
    add_edge(from, contour_px[(i + 1) % contour_px.size()] + half);
    low = {std::min(low.x, from.x), std::min(low.y, from.y)};
    high = {std::max(high.x, from.x), std::max(high.y, from.y)};
  }
  const auto pixel = [](double v, int end) {
    return static_cast<int>(std::floor(std::clamp(v, 0.0, static_cast<double>(end))));
  };
  const cv::Point first(pixel(low.x, picture_.width), pixel(low.y, picture_.height));
  const cv::Point last(std::min(pixel(high.x, picture_.width) + 1, picture_.width),
                       std::min(pixel(high.y, picture_.height) + 1, picture_.height));
  const cv::Rect box(first, last);
  box_ = box_.empty() ? box : box_ | box;
}

void Coverage::add_edge(cv::Point2d from, cv::Point2d to) {
  if (from.y == to.y) return;
  const double sign = from.y < to.y ? 1.0 : -1.0;
  if (sign < 0.0) std::swap(from, to);
  const double slope = (to.x - from.x) / (to.y - from.y);
  const double top = std::max(from.y, 0.0);
  const double bottom = std::min(to.y, static_cast<double>(picture_.height));
  for (int y = static_cast<int>(top); y < bottom; ++y) {
    const double y0 = std::max(top, static_cast<double>(y));
    const double y1 = std::min(bottom, static_cast<double>(y) + 1.0);
    add_row(cells_.data() + static_cast<std::size_t>(y) * stride_, from.x + slope * (y0 - from.y),
            from.x + slope * (y1 - from.y), sign * (y1 - y0));
  }
}

void Coverage::add_row(float* row, double x0, double x1, double height) const {
  if (x0 > x1) std::swap(x0, x1);
  const double right = picture_.width;
  if (x0 >= right) return;
  if (x1 <= 0.0) {
    row[0] += static_cast<float>(height);
    return;
  }
  const double per_px = x1 > x0 ? height / (x1 - x0) : 0.0;
  if (x0 < 0.0) {  // what lies left of the picture fills the row from its start
    row[0] += static_cast<float>(-x0 * per_px);
    height += x0 * per_px;
    x0 = 0.0;
  }
  if (x1 > right) {
    height -= (x1 - right) * per_px;
    x1 = right;
  }
  const int first = static_cast<int>(x0);
  const int last = std::min(static_cast<int>(x1), picture_.width);
  for (int cell = first; cell <= last; ++cell) {
    const double a = std::max(x0, static_cast<double>(cell));
    const double b = std::min(x1, cell + 1.0);
    const double part = first == last ? height : (b - a) * per_px;
    const double beyond = part * (0.5 * (a + b) - cell);
    row[cell] += static_cast<float>(part - beyond);
    row[cell + 1] += static_cast<float>(beyond);
  }
}

}  // namespace maggic::synthetic_match
