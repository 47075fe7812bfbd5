#include "maggic/field_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace maggic {
namespace {

constexpr int kStepsPerSide = 64;  // straight lines are bent by the lens

// The columns that a closed line reaches in every row of a picture.
class RowExtents {
 public:
  explicit RowExtents(cv::Size size_px)
      : size_px_(size_px), extents_(static_cast<std::size_t>(size_px.height)) {}

  void add_line(cv::Point2d a, cv::Point2d b) {
    const double last_row = size_px_.height - 1.0;
    const double last_column = size_px_.width - 1.0;
    const auto column = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, last_column)); };
    // A row more on either side: whoever is cut off by rounding would be cut in half.
    const double top = std::floor(std::min(a.y, b.y)) - 1.0;
    const double bottom = std::ceil(std::max(a.y, b.y)) + 1.0;
    if (bottom < 0.0 || top > last_row) return;
    const int left = column(std::floor(std::min(a.x, b.x)));
    const int right = column(std::ceil(std::max(a.x, b.x)));
    const auto first = static_cast<std::size_t>(std::max(top, 0.0));
    const auto last = static_cast<std::size_t>(std::min(bottom, last_row));
    for (std::size_t row = first; row <= last; ++row) {
      extents_[row].left = std::min(extents_[row].left, left);
      extents_[row].right = std::max(extents_[row].right, right);
    }
  }

  ScanArea area() const {
    ScanArea area;
    for (std::size_t row = 0; row < extents_.size(); ++row) {
      const auto& [left, right] = extents_[row];
      if (left > right) continue;
      area.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(left),
                      static_cast<std::uint16_t>(right + 1)});
    }
    return area;
  }

 private:
  struct Extent {
    int left = 65535;
    int right = -1;
  };

  cv::Size size_px_;
  std::vector<Extent> extents_;
};

// Between these two lies all that is looked for.
std::array<double, 2> outer_heights_mm(const Field& field) {
  return {0.0, std::max(field.robot_height_mm(), field.ball_height_mm())};
}

}  // namespace

ScanArea field_area(const Field& field, double margin_mm) {
  const FieldParameters& parameters = field.parameters();
  if (parameters.corners_px.empty()) return whole_picture(field.frame_size_px());
  const double x = parameters.length_mm / 2.0 + margin_mm;
  const double y = parameters.width_mm / 2.0 + margin_mm;
  const std::array<cv::Point2d, 5> outline{{{-x, y}, {x, y}, {x, -y}, {-x, -y}, {-x, y}}};
  RowExtents extents(field.frame_size_px());
  const auto add_side = [&](cv::Point2d from_mm, cv::Point2d to_mm, double from_height_mm,
                            double to_height_mm) {
    cv::Point2d last = field.to_image_px(from_mm, from_height_mm);
    for (int step = 1; step <= kStepsPerSide; ++step) {
      const double share = static_cast<double>(step) / kStepsPerSide;
      const cv::Point2d next =
          field.to_image_px(from_mm + share * (to_mm - from_mm),
                            from_height_mm + share * (to_height_mm - from_height_mm));
      extents.add_line(last, next);
      last = next;
    }
  };
  const auto heights_mm = outer_heights_mm(field);
  for (std::size_t side = 0; side + 1 < outline.size(); ++side) {
    for (const double height_mm : heights_mm) {
      add_side(outline[side], outline[side + 1], height_mm, height_mm);
    }
    // To a camera beside the field the upright edges stand out between floor and top.
    add_side(outline[side], outline[side], heights_mm.front(), heights_mm.back());
  }
  return extents.area();
}

double beyond_lines_mm(const Field& field, cv::Point2d point_px) {
  const FieldParameters& parameters = field.parameters();
  double nearest_mm = std::numeric_limits<double>::max();
  for (const double height_mm : outer_heights_mm(field)) {
    const cv::Point2d position_mm = field.to_field_mm(point_px, height_mm);
    nearest_mm =
        std::min(nearest_mm, std::max(std::abs(position_mm.x) - parameters.length_mm / 2.0,
                                      std::abs(position_mm.y) - parameters.width_mm / 2.0));
  }
  return std::max(nearest_mm, 0.0);
}

}  // namespace maggic
