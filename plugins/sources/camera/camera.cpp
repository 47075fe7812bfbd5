/// camera: a camera on this machine, kept alive.
///
///     source:
///       camera:
///         device: "0"             # number, or a path such as /dev/v4l/by-id/usb-…-video-index0,
///                                 # which stays the same whatever else is plugged in
///         backend: v4l2           # any: whatever of OpenCV's backends opens it first
///         fourcc: MJPG            # most USB cameras need it for high rates; empty: as it is
///         width: 1280             # both or neither
///         height: 720
///         fps: 60
///         exposure: 80            # in 100 µs (V4L2); auto, or keep: as it is
///         gain: 20                # in the camera's own steps; left out: as it is
///         white_balance: 4500     # in Kelvin; auto, or keep: as it is
///         buffers: 2              # pictures the driver may hold
///         required_at_start: false
///
/// Exposure, gain and white balance by hand keep colours the same all match long, and a short
/// exposure keeps moving tags sharp. What the camera does not take is warned about with what it
/// gives instead; everything is set anew when the camera comes back.
///
/// A camera that is not there, is pulled out, or gives no picture for a second is tried again after
/// 0.2 s, then at growing distances up to 5 s, while the program runs on; a warning says so when it
/// is lost and when it is back. `required_at_start: true` makes it an error not to find it at all.
///
/// Capture times: V4L2's own stamp of the picture where that makes sense (within the last second),
/// else the moment it was received; in Unix time, by a clock that does not jump when the machine's
/// is set. Pictures are fetched as they come, so none waits in the driver and a single buffer would
/// only cost frames: the driver needs one to fill while the last is being decoded.

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>
#include <opencv2/videoio.hpp>

#include "camera_settings.hpp"
#include "live/capture_clock.hpp"
#include "live/quiet_video_libraries.hpp"
#include "live/reconnecting_device.hpp"
#include "maggic/plugin.hpp"

namespace {

using maggic::camera::CameraSettings;
using maggic::camera::Control;

constexpr std::chrono::milliseconds kPatience{150};

enum class Backend { kV4l2, kAny };

bool is_number(const std::string& text) {
  return !text.empty() && text.size() <= 4 &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Why a device file cannot be opened, as far as the system can tell.
std::string reason_for(const std::string& device) {
  const std::string file = is_number(device) ? "/dev/video" + device : device;
  if (::access(file.c_str(), F_OK) != 0) return fmt::format("there is no {}", file);
  if (::access(file.c_str(), R_OK | W_OK) != 0) {
    return fmt::format("no permission for {} (is this user in the group 'video'?)", file);
  }
  return fmt::format("{} cannot be opened as a camera (in use by another program?)", file);
}

class CameraDevice final : public maggic::live::FrameDevice {
 public:
  CameraDevice(std::string device, Backend backend, CameraSettings settings, std::string name,
               maggic::Reporter& reporter)
      : device_(std::move(device)),
        backend_(backend == Backend::kV4l2 ? cv::CAP_V4L2 : cv::CAP_ANY),
        settings_(std::move(settings)),
        name_(std::move(name)),
        reporter_(reporter) {}

  std::optional<std::string> open() override {
    const bool opened = is_number(device_) ? capture_.open(std::stoi(device_), backend_)
                                           : capture_.open(device_, backend_);
    if (!opened) return reason_for(device_);
    for (const std::string& sentence : maggic::camera::apply(settings_, capture_)) {
      reporter_.warn(fmt::format("{}: {}", name_, sentence));
    }
    fps_ = std::max(0.0, capture_.get(cv::CAP_PROP_FPS));
    return std::nullopt;
  }

  std::optional<std::string> read(cv::Mat& picture, maggic::Timestamp& captured) override {
    if (!capture_.grab()) return "it was pulled out, or no picture came in time";
    captured = clock_.captured(capture_.get(cv::CAP_PROP_POS_MSEC));
    if (!capture_.retrieve(picture)) return "the picture could not be decoded";
    return std::nullopt;
  }

  void close() override { capture_.release(); }

  /// As the device said when it was opened last; 0 before.
  double fps() const { return fps_; }

 private:
  const std::string device_;
  const int backend_;
  const CameraSettings settings_;
  const std::string name_;
  maggic::Reporter& reporter_;
  const maggic::live::CaptureClock clock_;
  cv::VideoCapture capture_;
  std::atomic<double> fps_{0.0};
};

class Camera final : public maggic::Source {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"device", "number or path of the camera"}, device_);
    p.check("device", !device_.empty(),
            "is empty, expected a number or a path such as /dev/video0");
    p.choice({"backend", "how OpenCV reaches the camera"}, backend_,
             {{"v4l2", Backend::kV4l2}, {"any", Backend::kAny}});
    p.text({"fourcc", "pixel format, such as MJPG or YUYV; empty: as it is"}, settings_.fourcc);
    p.check("fourcc", settings_.fourcc.empty() || settings_.fourcc.size() == 4,
            "is not of four characters, expected one such as MJPG or YUYV");
    p.integer({"width", "width of the picture; none: as it is", "px"}, settings_.width_px,
              {1, 65535});
    p.integer({"height", "height of the picture; none: as it is", "px"}, settings_.height_px,
              {1, 65535});
    p.check(settings_.width_px ? "width" : "height",
            settings_.width_px.has_value() == settings_.height_px.has_value(),
            "stands alone, expected both width and height or neither");
    p.number({"fps", "pictures a second; none: as it is", "1/s"}, settings_.fps, {0.1, 10'000.0});
    describe_control(p, {"exposure", "auto, keep (as it is), or a time", "100 µs with V4L2"},
                     exposure_, settings_.exposure);
    p.number({"gain", "amplification; none: as it is", "the camera's own steps"}, settings_.gain,
             {0.0, 1e6});
    describe_control(p, {"white_balance", "auto, keep (as it is), or a colour temperature", "K"},
                     white_balance_, settings_.white_balance);
    p.integer({"buffers", "pictures the driver may hold, where it can be told"}, settings_.buffers,
              {1, 10});
    p.boolean({"required_at_start", "whether it is an error when the camera is not there at first"},
              required_at_start_);
  }

  void prepare(const maggic::StageContext& context) override { reporter_ = &context.reporter; }

  maggic::SourceInfo open() override {
    maggic::live::quiet_video_libraries();
    const std::string name = fmt::format("camera {}", device_);
    auto device = std::make_unique<CameraDevice>(device_, backend_, settings_, name, *reporter_);
    const CameraDevice& camera = *device;
    camera_.emplace(std::move(device), name, *reporter_);
    camera_->start(required_at_start_);
    maggic::SourceInfo info;
    info.live = true;
    info.frames_per_second = camera.fps() > 0.0 ? camera.fps() : settings_.fps.value_or(0.0);
    return info;
  }

  maggic::ReadStatus read(maggic::Frame& frame) override { return camera_->read(frame, kPatience); }

 private:
  static void describe_control(maggic::Parameters& p, const maggic::Parameter& what,
                               std::string& text, Control& control) {
    p.text(what, text);
    const std::optional<Control> read = maggic::camera::control_from(text);
    p.check(what.key, read.has_value(),
            fmt::format("found '{}', expected auto, keep, or a number from 0", text));
    control = read.value_or(Control{});
  }

  std::string device_ = "0";
  Backend backend_ = Backend::kV4l2;
  CameraSettings settings_;
  std::string exposure_ = "keep";
  std::string white_balance_ = "keep";
  bool required_at_start_ = false;

  maggic::Reporter* reporter_ = nullptr;
  std::optional<maggic::live::ReconnectingDevice> camera_;
};

}  // namespace

MAGGIC_PLUGIN(Camera, "a camera, opened again when it is lost; resolution, exposure, colour set")
