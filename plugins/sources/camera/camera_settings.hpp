#pragma once
/// What can be asked of a camera, and asking it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/videoio.hpp>

namespace maggic::camera {

/// A control that may be left alone, left to the camera, or given a value.
struct Control {
  enum class Mode { kKeep, kAuto, kValue };
  Mode mode = Mode::kKeep;
  double value = 0.0;

  bool operator==(const Control&) const = default;
};

/// "keep", "auto", or a number that is not negative; nothing for anything else.
std::optional<Control> control_from(std::string_view text);

/// What is empty, `keep` or absent stays as the device has it.
struct CameraSettings {
  std::optional<int> width_px;
  std::optional<int> height_px;
  std::optional<double> fps;
  std::string fourcc;  ///< Four characters, such as MJPG.
  Control exposure;    ///< V4L2: in 100 µs.
  std::optional<double> gain;
  Control white_balance;  ///< Kelvin.
  int buffers = 2;
};

/// Sets everything and reads it back.
/// @return one sentence for each thing the device did not take, with what it gives instead.
std::vector<std::string> apply(const CameraSettings& settings, cv::VideoCapture& device);

}  // namespace maggic::camera
