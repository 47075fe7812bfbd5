#pragma once
/// Boxes of colours: a range of values for each channel.

#include <algorithm>
#include <cstdint>

namespace maggic {

/// The 8-bit values first … last, both included; `first` is never above `last`. All 256 at first.
struct ChannelRange {
  std::uint8_t first = 0;
  std::uint8_t last = 255;

  friend bool operator==(const ChannelRange&, const ChannelRange&) = default;
};

/// Every colour whose channels lie in their ranges; never empty. The whole colour cube at first.
struct ColorBox {
  ChannelRange b;
  ChannelRange g;
  ChannelRange r;

  friend bool operator==(const ColorBox&, const ColorBox&) = default;
};

/// The values (largest channel) that the box's colours have; each end is some colour's.
inline ChannelRange value_range(const ColorBox& box) {
  return {std::max({box.b.first, box.g.first, box.r.first}),
          std::max({box.b.last, box.g.last, box.r.last})};
}

/// Whether a gray, all channels equal, is in the box.
inline bool holds_gray(const ColorBox& box) {
  return std::max({box.b.first, box.g.first, box.r.first}) <=
         std::min({box.b.last, box.g.last, box.r.last});
}

/// The spreads (largest channel minus smallest) that the box's colours have; each end is some
/// colour's.
inline ChannelRange spread_range(const ColorBox& box) {
  const int highest_first = std::max({box.b.first, box.g.first, box.r.first});
  const int lowest_last = std::min({box.b.last, box.g.last, box.r.last});
  // The largest spread lies between one channel's last value and another one's first.
  const int b_over = box.b.last - std::min(box.g.first, box.r.first);
  const int g_over = box.g.last - std::min(box.b.first, box.r.first);
  const int r_over = box.r.last - std::min(box.b.first, box.g.first);
  return {static_cast<std::uint8_t>(std::max(highest_first - lowest_last, 0)),
          static_cast<std::uint8_t>(std::max({b_over, g_over, r_over}))};
}

}  // namespace maggic
