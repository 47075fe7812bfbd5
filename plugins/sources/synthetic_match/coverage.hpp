#pragma once
/// Exact anti-aliasing: how much of every pixel a polygon covers.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

namespace maggic::synthetic_match {

/// Accumulates contours of one shape, then hands out the covered area of every pixel.
///
/// The areas are exact, not sampled: every edge adds its signed trapezoid to the pixels it crosses
/// and a running sum along the row fills what lies to its right (the method of font rasterisers).
/// Contours of opposite direction cut holes. A pixel is the unit square around its integer centre.
class Coverage {
 public:
  explicit Coverage(cv::Size picture);

  void add_contour(std::span<const cv::Point2d> contour_px);

  /// Calls paint(x, y, coverage in (0, 1]) for every pixel touched and starts a new shape.
  /// @return the box of the pixels looked at, inside the picture.
  template <class F>
  cv::Rect paint(F&& paint_pixel) {
    const cv::Rect box = box_;
    for (int y = box.y; y < box.br().y; ++y) {
      float* row = cells_.data() + static_cast<std::size_t>(y) * stride_;
      float sum = 0.0f;
      for (int x = box.x; x < box.br().x; ++x) {
        sum += row[x];
        const float covered = std::min(std::abs(sum), 1.0f);
        if (covered > kNothing) paint_pixel(x, y, covered);
      }
      std::fill(row + box.x, row + box.br().x + 2, 0.0f);
    }
    box_ = {};
    return box;
  }

 private:
  static constexpr float kNothing = 1e-5f;  // rounding left over by the running sum

  void add_edge(cv::Point2d from, cv::Point2d to);
  void add_row(float* row, double x0, double x1, double height) const;

  cv::Size picture_;
  std::size_t stride_;
  std::vector<float> cells_;
  cv::Rect box_;
};

}  // namespace maggic::synthetic_match
