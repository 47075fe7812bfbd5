/// video: a recording or a network stream.
///
///     source:
///       video:
///         path: match.mp4       # or rtsp://…, http://…, udp://… : anything with :// but file://
///         loop: false           # true: from the start again, for ever (recordings only)
///
/// Recordings. Capture times are the container's own, from 0 at the first frame; where it has none,
/// or they stand still or jump, frames are counted instead and one warning says so. With `loop` the
/// file is opened anew at its end and time runs on: its first frame comes one frame period after
/// its last. A rotation noted in the file is applied, as players do. A file without a single frame
/// that can be read is an error; one that ends before its header says so gives a warning.
///
/// Streams are live: the newest picture counts, stamped in Unix time as it arrives. A stream that
/// is not there or breaks off is opened again after 0.2 s, then at growing distances up to 5 s,
/// with a warning when it is lost and when it is back. For RTSP over TCP set the environment
/// variable OPENCV_FFMPEG_CAPTURE_OPTIONS=rtsp_transport;tcp.
///
/// OPENCV_FFMPEG_LOGLEVEL=24 and OPENCV_LOG_LEVEL=INFO bring the decoders' own words back.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>

#include "live/quiet_video_libraries.hpp"
#include "live/reconnecting_device.hpp"
#include "maggic/plugin.hpp"
#include "stream_device.hpp"
#include "video_clock.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPatience{150};

bool is_stream(std::string_view path) { return path.find("://") != std::string_view::npos; }

class Video final : public maggic::Source {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"path", "video file, or address of a stream (scheme://…)", "",
            maggic::Presence::kRequired},
           path_);
    p.boolean({"loop", "start again at the end, for ever; time runs on"}, loop_);
    p.check("loop", !(loop_ && is_stream(file_path())),
            "found true for a stream, expected it for a recording only");
  }

  void prepare(const maggic::StageContext& context) override { reporter_ = &context.reporter; }

  maggic::SourceInfo open() override {
    maggic::live::quiet_video_libraries();
    return is_stream(file_path()) ? open_stream() : open_file();
  }

  maggic::ReadStatus read(maggic::Frame& frame) override {
    if (stream_) return stream_->read(frame, kPatience);
    if (ended_) return maggic::ReadStatus::kEnd;
    if (!first_.empty()) {
      frame.bgr = std::exchange(first_, cv::Mat());
    } else if (!file_.read(frame.bgr) && !begin_again(frame.bgr)) {
      ended_ = true;
      file_.release();
      note_early_end();
      return maggic::ReadStatus::kEnd;
    }
    ++frames_read_;
    frame.captured = clock_->next(file_.get(cv::CAP_PROP_POS_MSEC));
    note_guessed_times();
    return maggic::ReadStatus::kFrame;
  }

 private:
  /// The path without `file://`.
  std::string file_path() const {
    constexpr std::string_view kFileScheme = "file://";
    return path_.starts_with(kFileScheme) ? path_.substr(kFileScheme.size()) : path_;
  }

  maggic::SourceInfo open_stream() {
    auto device = std::make_unique<maggic::video::StreamDevice>(path_);
    const maggic::video::StreamDevice& stream = *device;
    stream_.emplace(std::move(device), fmt::format("stream {}", path_), *reporter_);
    stream_->start(false);
    maggic::SourceInfo info;
    info.live = true;
    info.frames_per_second = stream.fps();
    return info;
  }

  maggic::SourceInfo open_file() {
    check_file();
    if (!read_first(first_)) {
      throw std::runtime_error(fmt::format(
          "no frame could be read from '{}': it is no video, is damaged, or is of a kind this "
          "OpenCV cannot decode",
          path_));
    }
    maggic::SourceInfo info;
    info.frames_per_second = maggic::video::plausible_rate(file_.get(cv::CAP_PROP_FPS));
    clock_.emplace(info.frames_per_second);
    // Containers that do not know answer with anything at all, negative numbers included.
    const double count = file_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1.0 && count < 1e9) frames_promised_ = static_cast<std::uint64_t>(count);
    if (!loop_) info.frame_count = frames_promised_;
    return info;
  }

  /// What the system knows better than a decoder's "cannot open".
  void check_file() const {
    const fs::path file = file_path();
    std::error_code failed;
    const fs::file_status status = fs::status(file, failed);
    const auto refuse = [&](std::string_view why) {
      throw std::runtime_error(fmt::format("cannot open '{}': {}", path_, why));
    };
    if (status.type() == fs::file_type::not_found) refuse("there is no such file");
    if (failed) refuse(failed.message());
    if (fs::is_directory(status)) {
      refuse("it is a folder, expected a video file (the source 'images' reads folders)");
    }
    if (fs::is_regular_file(status) && fs::file_size(file, failed) == 0) refuse("it is empty");
  }

  /// Opens the file at its beginning; seeking there fails for containers without an index.
  bool read_first(cv::Mat& picture) {
    // Other backends take text files for lists of pictures and start a media framework to find out.
    const int backend =
        cv::videoio_registry::hasBackend(cv::CAP_FFMPEG) ? cv::CAP_FFMPEG : cv::CAP_ANY;
    // Absolute, because FFmpeg takes what stands before a colon for a protocol.
    return file_.open(fs::absolute(file_path()).string(), backend) && file_.read(picture);
  }

  bool begin_again(cv::Mat& picture) {
    if (!loop_) return false;
    if (!read_first(picture)) {
      throw std::runtime_error(fmt::format("'{}' could not be opened again to loop", path_));
    }
    clock_->restart();
    return true;
  }

  void note_early_end() {
    // Containers without an index estimate, hence the slack.
    const std::uint64_t slack = 2 + frames_promised_.value_or(0) / 50;
    if (frames_promised_ && frames_read_ + slack < *frames_promised_) {
      reporter_->warn(fmt::format("'{}' ended after {} of {} frames: is it cut off or damaged?",
                                  path_, frames_read_, *frames_promised_));
    }
  }

  void note_guessed_times() {
    if (told_of_guesses_ || !clock_->guessed()) return;
    told_of_guesses_ = true;
    reporter_->warn(
        fmt::format("'{}' has no usable time for frame {}; such frames are taken to be "
                    "one frame period after the one before",
                    path_, frames_read_ - 1));
  }

  std::string path_;
  bool loop_ = false;

  maggic::Reporter* reporter_ = nullptr;
  std::optional<maggic::live::ReconnectingDevice> stream_;

  cv::VideoCapture file_;
  cv::Mat first_;  ///< Read while opening, given at the first `read`.
  std::optional<maggic::video::VideoClock> clock_;
  std::optional<std::uint64_t> frames_promised_;
  std::uint64_t frames_read_ = 0;
  bool ended_ = false;
  bool told_of_guesses_ = false;
};

}  // namespace

MAGGIC_PLUGIN(Video, "a video file, or a network stream that is opened again when it breaks off")
