#include "opencv_hsv.hpp"

#include <opencv2/core/fast_math.hpp>

#include "maggic/vectorized.hpp"

namespace maggic::hue_pivots {
namespace {

constexpr std::size_t kHueIndices = hue_index(255, 5 * 255) + 1;
constexpr int kShift = 12;

MAGGIC_VECTORIZED void write_indices(const ColorBatch& colors, std::uint32_t* __restrict indices) {
  const std::uint8_t* __restrict blue = colors.b.data();
  const std::uint8_t* __restrict green = colors.g.data();
  const std::uint8_t* __restrict red = colors.r.data();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    indices[i] = hue_index_of(blue[i], green[i], red[i]);
  }
}

}  // namespace

void hue_indices(const ColorBatch& colors, std::uint32_t* indices) {
  write_indices(colors, indices);
}

std::vector<std::uint8_t> opencv_hues() {
  std::vector<std::uint8_t> hues(kHueIndices, 0);
  for (int spread = 1; spread <= 255; ++spread) {
    const int scale = cvRound((kHues << kShift) / (6.0 * spread));
    for (int numerator = -spread; numerator <= 5 * spread; ++numerator) {
      const int hue = (numerator * scale + (1 << (kShift - 1))) >> kShift;
      hues[hue_index(static_cast<std::uint32_t>(spread), numerator)] =
          static_cast<std::uint8_t>(std::min(hue < 0 ? hue + kHues : hue, kHues - 1));
    }
  }
  return hues;
}

std::array<std::int32_t, 256> opencv_saturation_scales() {
  std::array<std::int32_t, 256> scales{};
  for (int value = 1; value < 256; ++value) {
    scales[static_cast<std::size_t>(value)] = cvRound((255 << kShift) / static_cast<double>(value));
  }
  return scales;
}

}  // namespace maggic::hue_pivots
