#include "maggic/scan_area.hpp"

namespace maggic {

ScanArea whole_picture(cv::Size size_px) {
  ScanArea area;
  if (size_px.width <= 0) return area;
  for (int row = 0; row < size_px.height; ++row) {
    area.push_back({static_cast<std::uint16_t>(row), 0, static_cast<std::uint16_t>(size_px.width)});
  }
  return area;
}

}  // namespace maggic
