#pragma once
/// Which pixels of a picture are looked at.

#include <cstdint>
#include <vector>

#include <opencv2/core/types.hpp>

namespace maggic {

/// Pixels [begin, end) of one row.
struct RowSpan {
  std::uint16_t row = 0;
  std::uint16_t begin = 0;
  std::uint16_t end = 0;
  friend bool operator==(const RowSpan&, const RowSpan&) = default;
};

/// The pixels to look at, by rows and then by columns, both ascending; spans are not empty and
/// neither overlap nor touch each other.
using ScanArea = std::vector<RowSpan>;

/// Every pixel of a picture. @param size_px at most 65535 a side.
ScanArea whole_picture(cv::Size size_px);

/// Whether an area has a pixel, given by column and row. The pixel may lie outside of the picture.
bool holds(const ScanArea& area, cv::Point pixel_px);

/// Whether `part` has every pixel of `box_px` that `whole` has; true when `whole` has none of them.
/// @param part of the pixels of `whole`.
/// @param box_px may reach out of the picture.
bool covers(const ScanArea& part, const ScanArea& whole, const cv::Rect& box_px);

}  // namespace maggic
