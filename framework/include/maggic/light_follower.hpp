#pragma once
/// Light that changes during a match: colours are taken back to the light they were calibrated in.
///
/// The floor with its lines is the same all day, so what its colour is now, over what it was then,
/// is what the light did. Each channel is multiplied by the inverse before the ColorTable is asked;
/// the method itself stays as calibrated, and nothing is multiplied while the light is as it was.

#include <array>
#include <cstdint>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "maggic/channel_gains.hpp"
#include "maggic/field.hpp"
#include "maggic/frame.hpp"
#include "maggic/parameters.hpp"

namespace maggic {

/// The `light:` section of a pipeline.
struct LightParameters {
  bool follow = false;
  /// `scene_color` at calibration, red, green, blue; needed to follow.
  std::optional<std::array<double, 3>> reference_rgb;
  double settle_s = 0.5;  ///< Time constant of the smoothing.

  void describe(Parameters& parameters);
};

/// Red, green and blue of the field as a whole, 8-bit steps: of each channel the mean of the middle
/// half of the values on a grid of pixels inside the field, so robots, lines and hands weigh
/// little.
/// @param bgr CV_8UC3, at least 1×1. @param field for pictures of this size.
std::array<double, 3> scene_color(const cv::Mat& bgr, const Field& field);

/// Follows the light over time. One thread at a time; allocates nothing.
class LightFollower {
 public:
  explicit LightFollower(const LightParameters& parameters) : parameters_(parameters) {}

  /// Looks at a frame. @return what to do to its colours; null while they are within 3 % of those
  /// at calibration (1.5 % once it has begun), or when not following. Valid until the next call.
  /// Factors are kept within 1/5 … 5. After a gap or a jump in time the light is believed at once,
  /// else smoothed.
  const ChannelGains* look(const cv::Mat& bgr, const Field& field, Timestamp captured);

  /// Factors on red, green, blue as smoothed so far, used or not; 1 before the first look.
  const std::array<double, 3>& gains() const { return gains_; }

 private:
  LightParameters parameters_;
  std::array<double, 3> gains_{1.0, 1.0, 1.0};
  std::array<double, 3> used_gains_{0.0, 0.0, 0.0};  ///< Those `fixed_` was made for.
  std::optional<Timestamp> last_;
  bool is_scaling_ = false;
  ChannelGains fixed_;
};

}  // namespace maggic
