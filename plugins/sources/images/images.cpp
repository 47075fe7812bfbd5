/// images: still pictures as a stream of frames.
///
/// For stills of a venue, for frames saved one by one, and to look at a single picture.
///
///     source:
///       images:
///         path: shots            # a file, a folder, or a pattern such as 'shots/img*.png'
///         fps: 30                # what the capture times are made of: picture n is taken at n/fps
///         loop: false            # true: from the start again, for ever; time runs on
///         exif_rotation: true    # turn pictures as their camera noted, like viewers do
///
/// Order: natural, img2 before img10. A folder gives its files named like pictures (png, jpg, …);
/// a pattern (`*`, `?`) gives all it matches. Gray, 16-bit and alpha pictures are fine, and the
/// size may change from one to the next. A file that cannot be read is passed over with a warning,
/// but keeps its moment in time; when none can be read at all, opening fails.
///
/// `exif_rotation: false` takes the pictures as the sensor saw them: right where a calibration was
/// made for the sensor, and for cameras that looked straight down, which note any orientation.

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "maggic/plugin.hpp"
#include "picture_list.hpp"
#include "picture_reader.hpp"

namespace {

class Images final : public maggic::Source {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"path", "picture, folder of pictures, or pattern with * and ?", "",
            maggic::Presence::kRequired},
           path_);
    p.number({"fps", "pictures a second; picture n is captured at n/fps", "1/s"}, fps_,
             {0.001, 10'000.0});
    p.boolean({"loop", "start again after the last picture, for ever; time runs on"}, loop_);
    p.boolean({"exif_rotation", "turn pictures as their EXIF orientation says"}, exif_rotation_);
  }

  void prepare(const maggic::StageContext& context) override { reporter_ = &context.reporter; }

  maggic::SourceInfo open() override {
    list_ = maggic::images::list_pictures(path_);
    reader_.emplace(exif_rotation_);
    if (!list_.passed_over.empty()) {
      reporter_->warn(fmt::format(
          "passed over {} files of '{}' that are not named like pictures, "
          "such as {}",
          list_.passed_over.size(), path_, list_.passed_over.front().filename().string()));
    }
    find_first();
    maggic::SourceInfo info;
    if (!loop_) info.frame_count = list_.files.size();
    info.frames_per_second = fps_;
    return info;
  }

  maggic::ReadStatus read(maggic::Frame& frame) override {
    if (!loop_ && position_ >= list_.files.size()) return maggic::ReadStatus::kEnd;
    const std::uint64_t position = position_++;
    if (!first_.empty()) {
      frame.bgr = std::exchange(first_, cv::Mat());
    } else if (!read_file(list_.files[position % list_.files.size()], frame.bgr)) {
      return maggic::ReadStatus::kRetry;
    }
    frame.captured = maggic::Timestamp(
        static_cast<maggic::Timestamp::rep>(static_cast<double>(position) * 1e9 / fps_));
    return maggic::ReadStatus::kFrame;
  }

 private:
  /// Reads ahead to the first good picture, so that a run without one ends before it starts.
  void find_first() {
    while (!read_file(list_.files[position_], first_)) ++position_;
  }

  bool read_file(const std::filesystem::path& file, cv::Mat& picture) {
    const std::optional<std::string> refusal = reader_->read(file, picture);
    if (!refusal) {
      refused_in_a_row_ = 0;
      return true;
    }
    if (++refused_in_a_row_ >= list_.files.size()) {
      throw std::runtime_error(fmt::format("no picture of '{}' could be read ({} tried; '{}': {})",
                                           path_, list_.files.size(), file.string(), *refusal));
    }
    reporter_->warn(fmt::format("'{}' is passed over: {}", file.string(), *refusal));
    return false;
  }

  std::string path_;
  double fps_ = 30.0;
  bool loop_ = false;
  bool exif_rotation_ = true;

  maggic::Reporter* reporter_ = nullptr;
  maggic::images::PictureList list_;
  std::optional<maggic::images::PictureReader> reader_;
  std::uint64_t position_ = 0;  ///< Of the next picture, counted on through every round.
  cv::Mat first_;
  std::size_t refused_in_a_row_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(Images, "still pictures: a file, a folder or a pattern")
