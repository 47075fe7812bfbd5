#include "maggic/scan_area.hpp"

#include <algorithm>
#include <tuple>

namespace maggic {
namespace {

/// The first span that does not end before (row, column).
ScanArea::const_iterator first_from(const ScanArea& area, int row, int column) {
  return std::ranges::lower_bound(area, std::tuple(row, column), {}, [](const RowSpan& span) {
    return std::tuple(int{span.row}, span.end - 1);
  });
}

}  // namespace

ScanArea whole_picture(cv::Size size_px) {
  ScanArea area;
  if (size_px.width <= 0) return area;
  for (int row = 0; row < size_px.height; ++row) {
    area.push_back({static_cast<std::uint16_t>(row), 0, static_cast<std::uint16_t>(size_px.width)});
  }
  return area;
}

bool holds(const ScanArea& area, cv::Point pixel_px) {
  const auto span = first_from(area, pixel_px.y, pixel_px.x);
  return span != area.end() && span->row == pixel_px.y && span->begin <= pixel_px.x;
}

bool covers(const ScanArea& part, const ScanArea& whole, const cv::Rect& box_px) {
  const int bottom = box_px.y + box_px.height;
  auto seen = first_from(part, box_px.y, box_px.x);
  for (auto span = first_from(whole, box_px.y, box_px.x); span != whole.end() && span->row < bottom;
       ++span) {
    const int begin = std::max<int>(box_px.x, span->begin);
    const int end = std::min<int>(box_px.x + box_px.width, span->end);
    if (begin >= end) continue;
    // Spans do not touch, so the first that ends past `begin` has all of it or none has.
    while (seen != part.end() &&
           (seen->row < span->row || (seen->row == span->row && seen->end <= begin))) {
      ++seen;
    }
    if (seen == part.end() || seen->row != span->row || seen->begin > begin || seen->end < end) {
      return false;
    }
  }
  return true;
}

}  // namespace maggic
