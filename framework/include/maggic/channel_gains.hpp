#pragma once
/// Colours multiplied channel by channel, in fixed point so that every way of computing it agrees.

#include <array>
#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace maggic {

/// A factor a channel: value v becomes min(255, floor(factor · v + 1/2)) with the factor rounded to
/// 1/4096.
class ChannelGains {
 public:
  static constexpr double kLargest = 65535.0 / 4096.0;

  /// All factors 1.
  ChannelGains() = default;
  /// @param factors on blue, green, red; taken into 0 … kLargest.
  explicit ChannelGains(const std::array<double, 3>& factors_bgr);

  /// What `value` of channel 0 (blue), 1 (green) or 2 (red) becomes.
  std::uint8_t operator()(std::size_t channel, std::uint8_t value) const {
    const std::uint32_t scaled = (std::uint32_t{value} * factors_q12_[channel] + 2048) >> 12;
    return static_cast<std::uint8_t>(scaled < 255 ? scaled : 255);
  }
  cv::Vec3b operator()(const cv::Vec3b& bgr) const {
    return {(*this)(0, bgr[0]), (*this)(1, bgr[1]), (*this)(2, bgr[2])};
  }

  /// Blue, green, red in steps of 1/4096.
  const std::array<std::uint16_t, 3>& factors_q12() const { return factors_q12_; }

  friend bool operator==(const ChannelGains&, const ChannelGains&) = default;

 private:
  std::array<std::uint16_t, 3> factors_q12_{4096, 4096, 4096};
};

/// Sends every pixel through `gains`. @param bgr CV_8UC3. @param scaled set to its size and type.
void apply(const ChannelGains& gains, const cv::Mat& bgr, cv::Mat& scaled);

}  // namespace maggic
