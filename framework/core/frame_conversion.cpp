#include "maggic/frame_conversion.hpp"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace maggic {
namespace {

constexpr int kMaxSide_px = 65535;

/// What one unit of `depth` is worth on the 8-bit scale; nothing for depths without a known white.
std::optional<double> scale_to_8_bit(int depth) {
  switch (depth) {
    case CV_8U: return 1.0;
    case CV_16U: return 1.0 / 257.0;
    case CV_32F:
    case CV_64F: return 255.0;
    default: return std::nullopt;
  }
}

}  // namespace

std::optional<std::string> convert_to_bgr8(cv::Mat& picture) {
  if (picture.type() == CV_8UC3 && picture.dims == 2 && !picture.empty() &&
      picture.cols <= kMaxSide_px && picture.rows <= kMaxSide_px) {
    return std::nullopt;
  }
  if (picture.empty()) return "it is empty";
  if (picture.dims != 2) return fmt::format("it has {} dimensions, expected 2", picture.dims);
  const int channels = picture.channels();
  if (channels != 1 && channels != 3 && channels != 4) {
    return fmt::format("it has {} channels, expected 1 (gray), 3 (BGR) or 4 (BGR and alpha)",
                       channels);
  }
  if (picture.cols > kMaxSide_px || picture.rows > kMaxSide_px) {
    return fmt::format("{} × {} pixels, more than {} a side", picture.cols, picture.rows,
                       kMaxSide_px);
  }
  const std::optional<double> scale = scale_to_8_bit(picture.depth());
  if (!scale) {
    return fmt::format("its values are of type {}, expected 8 or 16 bit unsigned, or float",
                       cv::typeToString(CV_MAT_DEPTH(picture.type())));
  }

  cv::Mat converted;
  if (picture.depth() == CV_8U) {
    converted = picture;
  } else {
    picture.convertTo(converted, CV_8U, *scale);
  }
  if (channels == 3) {
    picture = converted;
  } else {
    // Never into `picture`: its memory may be lent, and the colours of a row would overlap.
    cv::Mat bgr;
    cv::cvtColor(converted, bgr, channels == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
    picture = bgr;
  }
  return std::nullopt;
}

}  // namespace maggic
