#include "maggic/light_follower.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr int kGridSteps = 64;         // along the field's longer side
constexpr double kInsideShare = 0.92;  // of the field: no walls
constexpr double kUnchanged = 0.03;
constexpr double kWorthNewGains = 0.004;  // smaller changes keep those there are
constexpr double kMostGain = 5.0;
constexpr double kMaxGapS = 2.0;
constexpr double kDarkest = 1.0;  // 8-bit steps; of less nothing can be told

/// Mean of the middle half.
double middle_mean(const std::array<int, 256>& histogram, int count) {
  const double from = 0.25 * count;
  const double to = 0.75 * count;
  double below = 0.0;
  double sum = 0.0;
  for (int value = 0; value < 256; ++value) {
    const double above = below + histogram[static_cast<std::size_t>(value)];
    sum += value * std::max(0.0, std::min(above, to) - std::max(below, from));
    below = above;
  }
  return sum / (to - from);
}

double largest_step(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double largest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]) / b[c]);
  return largest;
}

}  // namespace

void LightParameters::describe(Parameters& p) {
  p.boolean({"follow", "take colours back to the light of the calibration when the hall's changes"},
            follow);
  std::array<double, 3> rgb = reference_rgb.value_or(std::array<double, 3>{0.0, 0.0, 0.0});
  p.numbers({"reference_rgb",
             "red, green, blue of the field at calibration, which maggic calibrate "
             "writes; [0, 0, 0]: unknown",
             "8-bit steps"},
            rgb, {0.0, 255.0});
  const bool known = std::ranges::all_of(rgb, [](double v) { return v >= kDarkest; });
  reference_rgb = known ? std::optional(rgb) : std::nullopt;
  p.number({"settle_s", "how fast the light is followed: time constant", "s"}, settle_s,
           {0.0, 60.0});
  p.check("follow", !follow || known,
          "found true without reference_rgb, expected the field's colour at calibration beside it "
          "(maggic calibrate writes it)");
}

std::array<double, 3> scene_color(const cv::Mat& bgr, const Field& field) {
  const double x = kInsideShare * field.parameters().length_mm / 2.0;
  const double y = kInsideShare * field.parameters().width_mm / 2.0;
  const int steps_x = kGridSteps;
  const int steps_y = std::max(2, static_cast<int>(kGridSteps * y / x));
  std::array<std::array<int, 256>, 3> histograms{};
  int count = 0;
  const cv::Rect picture({}, bgr.size());
  // The grid is laid in the picture between the field's corners: good enough, and cheap.
  const cv::Point2d a = field.to_image_px({-x, y}, 0.0);
  const cv::Point2d b = field.to_image_px({x, y}, 0.0);
  const cv::Point2d c = field.to_image_px({-x, -y}, 0.0);
  const cv::Point2d d = field.to_image_px({x, -y}, 0.0);
  for (int j = 0; j < steps_y; ++j) {
    const double v = (j + 0.5) / steps_y;
    for (int i = 0; i < steps_x; ++i) {
      const double u = (i + 0.5) / steps_x;
      const cv::Point2d p = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
      const cv::Point pixel(cvRound(p.x), cvRound(p.y));
      if (!picture.contains(pixel)) continue;
      const cv::Vec3b& color = bgr.at<cv::Vec3b>(pixel);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        ++histograms[channel][color[static_cast<int>(2 - channel)]];
      }
      ++count;
    }
  }
  std::array<double, 3> mean{};
  if (count == 0) return mean;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    mean[channel] = middle_mean(histograms[channel], count);
  }
  return mean;
}

const ChannelGains* LightFollower::look(const cv::Mat& bgr, const Field& field,
                                        Timestamp captured) {
  if (!parameters_.follow || !parameters_.reference_rgb) return nullptr;
  const std::array<double, 3> now = scene_color(bgr, field);
  // A black picture says nothing of the light: what was known of it stands.
  if (std::ranges::min(now) < kDarkest) return last_ && is_scaling_ ? &fixed_ : nullptr;
  const double dt_s =
      last_ ? std::chrono::duration<double>(captured - *last_).count() : kMaxGapS + 1.0;
  last_ = captured;
  const bool follows_on = dt_s >= 0.0 && dt_s <= kMaxGapS && parameters_.settle_s > 0.0;
  const double share = follows_on ? 1.0 - std::exp(-dt_s / parameters_.settle_s) : 1.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double wanted =
        std::clamp((*parameters_.reference_rgb)[c] / now[c], 1.0 / kMostGain, kMostGain);
    gains_[c] += share * (wanted - gains_[c]);
  }
  // Once begun it goes on until the light is nearer still, so that it never flickers at the edge.
  is_scaling_ =
      largest_step(gains_, {1.0, 1.0, 1.0}) > (is_scaling_ ? kUnchanged / 2.0 : kUnchanged);
  if (!is_scaling_) return nullptr;
  if (used_gains_[0] <= 0.0 || largest_step(gains_, used_gains_) > kWorthNewGains) {
    fixed_ = ChannelGains({gains_[2], gains_[1], gains_[0]});
    used_gains_ = gains_;
  }
  return &fixed_;
}

}  // namespace maggic
