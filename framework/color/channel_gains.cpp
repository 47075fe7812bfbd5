#include "maggic/channel_gains.hpp"

#include <algorithm>
#include <cmath>

namespace maggic {

ChannelGains::ChannelGains(const std::array<double, 3>& factors_bgr) {
  for (std::size_t channel = 0; channel < factors_bgr.size(); ++channel) {
    const double steps = std::clamp(std::round(factors_bgr[channel] * 4096.0), 0.0, 65535.0);
    factors_q12_[channel] = static_cast<std::uint16_t>(steps);
  }
}

void apply(const ChannelGains& gains, const cv::Mat& bgr, cv::Mat& scaled) {
  CV_Assert(bgr.type() == CV_8UC3);
  scaled.create(bgr.size(), CV_8UC3);
  for (int y = 0; y < bgr.rows; ++y) {
    const std::uint8_t* in = bgr.ptr(y);
    std::uint8_t* out = scaled.ptr(y);
    for (int x = 0; x < bgr.cols; ++x, in += 3, out += 3) {
      for (std::size_t channel = 0; channel < 3; ++channel)
        out[channel] = gains(channel, in[channel]);
    }
  }
}

}  // namespace maggic
