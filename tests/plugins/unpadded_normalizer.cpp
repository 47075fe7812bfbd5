/// Broken on purpose: takes a padded picture for one block of memory and writes over its padding.

#include <algorithm>

#include "maggic/plugin.hpp"

namespace {

class UnpaddedNormalizer final : public maggic::ImageNormalizer {
 public:
  void normalize(const cv::Mat& bgr, cv::Mat& normalized) override {
    bgr.copyTo(normalized);
    for (int row = 0; row + 1 < normalized.rows; ++row) {
      std::uint8_t* const begin = normalized.ptr(row);
      std::fill(begin + 3 * normalized.cols, normalized.ptr(row + 1), std::uint8_t{0});
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(UnpaddedNormalizer, "writes over the padding of rows")
