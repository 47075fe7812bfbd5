/// overlay_video: an annotated video of what was found, to look at and to show.
///
/// Field outline and axes, tags in their colours, team and id, heading, ball with trail and speed,
/// what is predicted dashed, and a caption with frame, time and ms a step; see maggic/overlay.hpp.
///
///     sinks:
///       - overlay_video:
///           path: out/overlay.mp4
///           codec: auto            # mp4v where this OpenCV can write it, avc1 otherwise; avc1
///                                  # plays in browsers too but takes several times as long
///           scale: 0               # 0: small pictures are enlarged twice
///           frames_per_second: 0   # 0: the source's own
///
/// The folder of `path` must exist; an existing file is replaced. The first frame sets the video's
/// size; frames of another size are fitted into it with black bars. The file can be played once
/// the run has ended, and is read back then to make sure that it is complete.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "maggic/overlay.hpp"
#include "maggic/plugin.hpp"

namespace {

constexpr double kUsualFramesPerSecond = 30.0;

enum class Codec { kAuto, kAvc1, kMp4v, kMjpg };

class OverlayVideo final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"path", "video file to write, such as overlay.mp4", "", maggic::Presence::kRequired},
           path_);
    p.check("path", std::filesystem::path(path_).has_extension(),
            "has no extension, expected a video file such as overlay.mp4");
    p.choice({"codec", "how the video is compressed"}, codec_,
             {{"auto", Codec::kAuto},
              {"avc1", Codec::kAvc1},
              {"mp4v", Codec::kMp4v},
              {"mjpg", Codec::kMjpg}});
    p.integer({"scale", "enlargement of the picture; 0: twice for pictures below 960 pixels wide"},
              options_.scale, {0, 8});
    p.number({"frames_per_second", "playing speed; 0: the source's own, 30 if it has none", "1/s"},
             frames_per_second_, {0.0, 1000.0});
    p.boolean({"field_lines", "draw the calibrated field and its axes"}, options_.field_lines);
    p.boolean({"caption", "strip with frame, time and ms a step"}, options_.caption);
    p.integer({"ball_trail_frames", "length of the ball's trail", "frames"},
              options_.ball_trail_frames, {0, 1000});
  }

  void open(const maggic::RunInfo& info) override {
    const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
      throw std::runtime_error(
          fmt::format("cannot write '{}': folder {} does not exist", path_, folder.string()));
    }
    if (std::filesystem::is_directory(path_, ignored)) {
      throw std::runtime_error(fmt::format("cannot write '{}': it is a folder", path_));
    }
    overlay_.emplace(info.palette, options_);
    if (frames_per_second_ <= 0.0) frames_per_second_ = info.source.frames_per_second;
    if (frames_per_second_ <= 0.0) frames_per_second_ = kUsualFramesPerSecond;
  }

  void write(const maggic::FrameResult& result, const maggic::Field& field) override {
    if (result.frame.bgr.empty()) return;
    overlay_->draw(result, field, drawn_);
    if (!writer_.isOpened()) open_writer(drawn_.size());
    if (drawn_.size() == video_size_) {
      writer_.write(drawn_);
    } else {
      letterbox();
      writer_.write(boxed_);
    }
    ++frames_written_;
  }

  void close() override {
    if (!writer_.isOpened()) return;
    writer_.release();
    check_complete();
  }

 private:
  void open_writer(cv::Size size) {
    video_size_ = size;
    const auto opens = [&](const char* fourcc) {
      const int code = cv::VideoWriter::fourcc(fourcc[0], fourcc[1], fourcc[2], fourcc[3]);
      return writer_.open(path_, cv::CAP_FFMPEG, code, frames_per_second_, size);
    };
    bool opened = false;
    switch (codec_) {
      case Codec::kAuto: opened = opens("mp4v") || opens("avc1"); break;
      case Codec::kAvc1: opened = opens("avc1"); break;
      case Codec::kMp4v: opened = opens("mp4v"); break;
      case Codec::kMjpg: opened = opens("MJPG"); break;
    }
    if (!opened) {
      throw std::runtime_error(fmt::format(
          "cannot write '{}': it cannot be created, or OpenCV has no encoder for it ({}×{} at "
          "{:g} frames a second)",
          path_, size.width, size.height, frames_per_second_));
    }
  }

  void letterbox() {
    const double ratio = std::min(static_cast<double>(video_size_.width) / drawn_.cols,
                                  static_cast<double>(video_size_.height) / drawn_.rows);
    const cv::Size inner(std::clamp(cvRound(drawn_.cols * ratio), 1, video_size_.width),
                         std::clamp(cvRound(drawn_.rows * ratio), 1, video_size_.height));
    boxed_.create(video_size_, CV_8UC3);
    boxed_.setTo(cv::Scalar::all(0));
    cv::Mat area = boxed_(cv::Rect(
        cv::Point((video_size_.width - inner.width) / 2, (video_size_.height - inner.height) / 2),
        inner));
    cv::resize(drawn_, area, inner, 0, 0, cv::INTER_AREA);
  }

  /// cv::VideoWriter tells nobody when the disk is full; the container's own frame count does.
  void check_complete() const {
    cv::VideoCapture file(path_, cv::CAP_FFMPEG);
    const double frames = file.isOpened() ? file.get(cv::CAP_PROP_FRAME_COUNT) : 0.0;
    // Containers without an index give an estimate, hence the slack of one frame.
    if (frames + 1.0 < static_cast<double>(frames_written_)) {
      throw std::runtime_error(fmt::format(
          "'{}' is not complete: {} frames were written, {:.0f} can be read (is the disk full?)",
          path_, frames_written_, std::max(frames, 0.0)));
    }
  }

  std::string path_;
  Codec codec_ = Codec::kAuto;
  double frames_per_second_ = 0.0;
  maggic::OverlayOptions options_;

  std::optional<maggic::Overlay> overlay_;
  cv::VideoWriter writer_;
  cv::Size video_size_;
  cv::Mat drawn_;
  cv::Mat boxed_;
  std::uint64_t frames_written_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(OverlayVideo, "writes an annotated video: tags, ids, headings, ball, ms a step")
