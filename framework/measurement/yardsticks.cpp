#include "measurement/yardsticks.hpp"

#include <cstddef>
#include <cstdint>

// The same sets as for the scan, so that both follow the same choice.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "measurement/yardsticks.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace maggic {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Written past the caches where the vectors are aligned: nobody reads the bytes, and a store
// through the caches would read their lines first.
template <bool kPastCaches>
void join_channels_with(const std::uint8_t* bgr, std::size_t pixels, std::uint8_t* ors) {
  const hn::ScalableTag<std::uint8_t> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= pixels; i += lanes) {
    auto b = hn::Zero(d);
    auto g = hn::Zero(d);
    auto r = hn::Zero(d);
    hn::LoadInterleaved3(d, bgr + 3 * i, b, g, r);
    const auto joined = hn::Or(hn::Or(b, g), r);
    if constexpr (kPastCaches) {
      hn::Stream(joined, d, ors + i);
    } else {
      hn::StoreU(joined, d, ors + i);
    }
  }
  if constexpr (kPastCaches) hwy::FlushStream();
  for (; i < pixels; ++i) {
    ors[i] = static_cast<std::uint8_t>(bgr[3 * i] | bgr[3 * i + 1] | bgr[3 * i + 2]);
  }
}

void join_channels_of(const std::uint8_t* bgr, std::size_t pixels, std::uint8_t* ors) {
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<std::uint8_t>());
  if (reinterpret_cast<std::uintptr_t>(ors) % lanes == 0) {
    join_channels_with<true>(bgr, pixels, ors);
  } else {
    join_channels_with<false>(bgr, pixels, ors);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace maggic
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace maggic {
namespace {

HWY_EXPORT(join_channels_of);

constexpr std::size_t index_of(std::uint32_t b, std::uint32_t g, std::uint32_t r) {
  return b | g << 8 | r << 16;
}

}  // namespace

void join_channels(const cv::Mat& bgr, cv::Mat& ors) {
  CV_Assert(bgr.type() == CV_8UC3);
  ors.create(bgr.size(), CV_8UC1);
  const bool in_one = bgr.isContinuous() && ors.isContinuous();
  const int rows = in_one ? 1 : bgr.rows;
  const std::size_t pixels = in_one ? bgr.total() : static_cast<std::size_t>(bgr.cols);
  for (int y = 0; y < rows; ++y) {
    HWY_DYNAMIC_DISPATCH(join_channels_of)(bgr.ptr(y), pixels, ors.ptr(y));
  }
}

std::vector<Label> flat_labels(const ColorTable& table) {
  std::vector<Label> flat(ColorTable::kColors);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    flat[i] = table(static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8),
                    static_cast<std::uint8_t>(i >> 16));
  }
  return flat;
}

void look_up_each_pixel(const cv::Mat& bgr, const std::vector<Label>& flat, cv::Mat& labels) {
  CV_Assert(bgr.type() == CV_8UC3 && flat.size() == ColorTable::kColors);
  labels.create(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* const pixels = bgr.ptr<cv::Vec3b>(y);
    Label* const row = labels.ptr(y);
    for (int x = 0; x < bgr.cols; ++x) {
      row[x] = flat[index_of(pixels[x][0], pixels[x][1], pixels[x][2])];
    }
  }
}

}  // namespace maggic
#endif  // HWY_ONCE
