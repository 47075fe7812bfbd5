#pragma once
/// Memory to hand out with bytes around it that nobody may touch.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace maggic::testing {

inline constexpr std::uint8_t kGuard = 0xA5;

/// `size` bytes of `fill` between guard bytes. Starts at an odd address, as a batch in the middle
/// of a row does.
class GuardedBytes {
 public:
  GuardedBytes(std::size_t size, std::uint8_t fill)
      : size_(size), bytes_(size + 2 * kMargin, kGuard) {
    std::ranges::fill(span(), fill);
  }
  std::span<std::uint8_t> span() { return std::span(bytes_).subspan(kMargin, size_); }
  bool intact() const {
    const auto is_guard = [](std::uint8_t byte) { return byte == kGuard; };
    return std::all_of(bytes_.begin(), bytes_.begin() + kMargin, is_guard) &&
           std::all_of(bytes_.end() - kMargin, bytes_.end(), is_guard);
  }

 private:
  static constexpr std::ptrdiff_t kMargin = 65;  // odd, and wider than a vector register
  std::size_t size_;
  std::vector<std::uint8_t> bytes_;
};

/// A picture with padded rows: a window of a larger one whose other bytes are guards.
class GuardedImage {
 public:
  GuardedImage(cv::Size size, int type, std::uint8_t fill)
      : whole_(size.height + 2 * kMargin, size.width + 2 * kMargin, type),
        window_(kMargin, kMargin, size.width, size.height) {
    whole_.setTo(cv::Scalar::all(kGuard));
    view().setTo(cv::Scalar::all(fill));
  }
  cv::Mat view() const { return whole_(window_); }
  bool intact() const {
    const std::size_t pixel = whole_.elemSize();
    for (int row = 0; row < whole_.rows; ++row) {
      const std::span bytes(whole_.ptr(row), pixel * static_cast<std::size_t>(whole_.cols));
      const bool crosses = row >= window_.y && row < window_.br().y;
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        const int column = static_cast<int>(i / pixel);
        const bool inside = crosses && column >= window_.x && column < window_.br().x;
        if (!inside && bytes[i] != kGuard) return false;
      }
    }
    return true;
  }

 private:
  static constexpr int kMargin = 3;
  cv::Mat whole_;
  cv::Rect window_;
};

}  // namespace maggic::testing
