#include "camera_settings.hpp"

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

namespace maggic::camera {
namespace {

// V4L2_CID_EXPOSURE_AUTO. Cameras know one of the two automatic modes, nearly always the latter.
constexpr double kExposureManual = 1.0;
constexpr double kExposureAuto = 0.0;
constexpr double kExposureAperturePriority = 3.0;

class Applier {
 public:
  explicit Applier(cv::VideoCapture& device) : device_(device) {}

  void set(std::string_view name, int property, double wanted, double tolerance) {
    device_.set(property, wanted);
    verify(name, property, wanted, tolerance);
  }

  void verify(std::string_view name, int property, double wanted, double tolerance) {
    const double given = device_.get(property);
    if (std::abs(given - wanted) <= tolerance) return;
    if (given < 0.0) {  // what drivers answer for a control they do not have
      refuse(fmt::format("the device does not take {} {:g}", name, wanted));
    } else {
      refuse(fmt::format("asked for {} {:g}, the device gives {:g}", name, wanted, given));
    }
  }

  void set_fourcc(const std::string& wanted) {
    const int code = cv::VideoWriter::fourcc(wanted[0], wanted[1], wanted[2], wanted[3]);
    device_.set(cv::CAP_PROP_FOURCC, code);
    const auto given = static_cast<unsigned>(device_.get(cv::CAP_PROP_FOURCC));
    if (given == static_cast<unsigned>(code)) return;
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
      const char c = static_cast<char>(given >> shift & 0xFFu);
      text += c >= ' ' && c <= '~' ? c : '?';
    }
    refuse(fmt::format("asked for fourcc {}, the device gives {}", wanted, text));
  }

  /// Tries the values in turn until the device keeps one.
  void set_mode(std::string_view name, int property, std::initializer_list<double> values) {
    for (const double value : values) {
      device_.set(property, value);
      if (device_.get(property) == value) return;
    }
    refuse(fmt::format("the device does not take {}", name));
  }

  std::vector<std::string> take() { return std::move(refused_); }

 private:
  void refuse(std::string sentence) { refused_.push_back(std::move(sentence)); }

  cv::VideoCapture& device_;
  std::vector<std::string> refused_;
};

}  // namespace

std::optional<Control> control_from(std::string_view text) {
  if (text == "keep") return Control{};
  if (text == "auto") return Control{Control::Mode::kAuto, 0.0};
  Control control{Control::Mode::kValue, 0.0};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, control.value);
  const bool is_number = error == std::errc() && stopped == end && std::isfinite(control.value);
  if (!is_number || control.value < 0.0) return std::nullopt;
  return control;
}

std::vector<std::string> apply(const CameraSettings& settings, cv::VideoCapture& device) {
  Applier applier(device);
  // The format first: it decides which sizes there are, and these which rates.
  if (!settings.fourcc.empty()) applier.set_fourcc(settings.fourcc);
  if (settings.width_px && settings.height_px) {
    // V4L2 changes the size at the second of the two, so both are verified after it.
    device.set(cv::CAP_PROP_FRAME_WIDTH, *settings.width_px);
    device.set(cv::CAP_PROP_FRAME_HEIGHT, *settings.height_px);
    applier.verify("width", cv::CAP_PROP_FRAME_WIDTH, *settings.width_px, 0.5);
    applier.verify("height", cv::CAP_PROP_FRAME_HEIGHT, *settings.height_px, 0.5);
  }
  if (settings.fps) applier.set("fps", cv::CAP_PROP_FPS, *settings.fps, 0.01 * *settings.fps);
  // Not verified: drivers round it up to what they need.
  device.set(cv::CAP_PROP_BUFFERSIZE, settings.buffers);

  switch (settings.exposure.mode) {
    case Control::Mode::kKeep: break;
    case Control::Mode::kAuto:
      applier.set_mode("exposure auto", cv::CAP_PROP_AUTO_EXPOSURE,
                       {kExposureAperturePriority, kExposureAuto});
      break;
    case Control::Mode::kValue:
      applier.set_mode("exposure by hand", cv::CAP_PROP_AUTO_EXPOSURE, {kExposureManual});
      applier.set("exposure", cv::CAP_PROP_EXPOSURE, settings.exposure.value, 0.5);
      break;
  }
  if (settings.gain) applier.set("gain", cv::CAP_PROP_GAIN, *settings.gain, 0.5);
  switch (settings.white_balance.mode) {
    case Control::Mode::kKeep: break;
    case Control::Mode::kAuto:
      applier.set_mode("white_balance auto", cv::CAP_PROP_AUTO_WB, {1.0});
      break;
    case Control::Mode::kValue:
      applier.set_mode("white_balance by hand", cv::CAP_PROP_AUTO_WB, {0.0});
      applier.set("white_balance", cv::CAP_PROP_WB_TEMPERATURE, settings.white_balance.value, 0.5);
      break;
  }
  return applier.take();
}

}  // namespace maggic::camera
