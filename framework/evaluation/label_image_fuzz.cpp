/// Pictures of labels come from whoever drew them.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "maggic/label_image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const int type = data[0] % 32;  // any depth, up to four channels
  const int columns = 1 + data[1] % 16;
  const auto row_bytes = static_cast<std::size_t>(columns) * CV_ELEM_SIZE(type);
  const int rows = static_cast<int>((size - 2) / row_bytes);
  const cv::Mat picture(rows, columns, type, const_cast<std::uint8_t*>(data + 2));
  const maggic::Palette palette = maggic::Palette::standard();
  try {
    const cv::Mat labels = maggic::labels_of(picture, palette);
    double largest = 0.0;
    cv::minMaxLoc(labels, nullptr, &largest);
    if (labels.size() != picture.size() || largest >= static_cast<double>(palette.size())) {
      std::abort();
    }
  } catch (const std::invalid_argument&) {
    // What is no picture of labels is refused.
  }
  return 0;
}
