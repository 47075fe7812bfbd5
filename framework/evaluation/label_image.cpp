#include "maggic/label_image.hpp"

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>
#include <opencv2/core.hpp>

namespace maggic {
namespace {

cv::Mat from_gray(const cv::Mat& picture, const Palette& palette) {
  for (int y = 0; y < picture.rows; ++y) {
    const auto* row = picture.ptr<std::uint8_t>(y);
    for (int x = 0; x < picture.cols; ++x) {
      if (row[x] < palette.size()) continue;
      throw std::invalid_argument(fmt::format(
          "gray value {} at x {}, y {} is no label: expected 0 for background or 1 … {} for {}",
          row[x], x, y, palette.size() - 1, palette.known_names()));
    }
  }
  return picture.clone();
}

cv::Mat from_display_colors(const cv::Mat& picture, const Palette& palette) {
  const auto key_of = [](int r, int g, int b) { return r << 16 | g << 8 | b; };
  std::unordered_map<int, Label> label_of;
  for (std::size_t label = 0; label < palette.size(); ++label) {
    const DisplayColor color = palette.display_color(static_cast<Label>(label));
    label_of.emplace(key_of(color.red, color.green, color.blue), static_cast<Label>(label));
  }
  cv::Mat labels(picture.size(), CV_8UC1);
  const int channels = picture.channels();
  for (int y = 0; y < picture.rows; ++y) {
    const auto* row = picture.ptr<std::uint8_t>(y);
    for (int x = 0; x < picture.cols; ++x, row += channels) {
      const auto found = label_of.find(key_of(row[2], row[1], row[0]));
      if (found == label_of.end()) {
        throw std::invalid_argument(fmt::format(
            "the colour {} {} {} (red, green, blue) at x {}, y {} is none the palette draws: "
            "expected black for background or the display colour of {}",
            row[2], row[1], row[0], x, y, palette.known_names()));
      }
      labels.at<Label>(y, x) = found->second;
    }
  }
  return labels;
}

}  // namespace

cv::Mat labels_of(const cv::Mat& picture, const Palette& palette) {
  const int channels = picture.channels();
  if (picture.empty() || picture.depth() != CV_8U || channels == 2 || channels > 4) {
    throw std::invalid_argument(fmt::format(
        "found {} channel{} of {} bits, expected 8-bit gray values or colours",
        picture.empty() ? 0 : channels, channels == 1 ? "" : "s", 8 * picture.elemSize1()));
  }
  return channels == 1 ? from_gray(picture, palette) : from_display_colors(picture, palette);
}

}  // namespace maggic
