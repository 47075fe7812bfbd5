#pragma once
/// The frame path: from a frame to detections through the configured stages.

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "maggic/blob_extractor.hpp"
#include "maggic/color_table.hpp"
#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"
#include "maggic/light_follower.hpp"
#include "maggic/plugin_registry.hpp"
#include "maggic/run_scanner.hpp"
#include "maggic/scan_area.hpp"
#include "maggic/scan_parameters.hpp"

namespace maggic {

class ImagePath;
class PredictedSearch;

/// A stage threw. `what()`: "<kind> '<name>' failed at frame <n>: <message>". Made while the
/// plugin's library is held, so it outlives the plugin safely.
class StageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A stage and the name of its plugin.
template <class T>
struct NamedStage {
  std::string name;
  StagePtr<T> stage;
};

/// The `blobs:` section of a pipeline. Areas in mm² of the field at the robots' tag height.
struct BlobParameters {
  double min_area_mm2 = 100.0;
  double max_area_mm2 = 8000.0;
  int max_blobs = 1024;
  int max_runs = 32768;

  void describe(Parameters& parameters);
};

/// Everything the frame path is made of, configured and prepared.
struct PipelineParts {
  Palette palette;
  FieldParameters field;
  BlobParameters blobs;
  LightParameters light;
  ScanParameters scan;
  NamedStage<Normalizer> normalizer;
  NamedStage<Segmenter> segmenter;
  NamedStage<Tracker> tracker;
};

/// What `process` made of a frame.
enum class FrameOutcome {
  kProcessed,
  kSkipped,  ///< No picture in it, or one that cannot be converted; told through the reporter.
};

/// Runs frames through the stages. One thread at a time. Allocates nothing per frame once warm, that
/// is, for FrameResults it filled before; pictures that have to be converted are the exception.
class Pipeline {
 public:
  /// Compiles the ColorTable where both stages depend on colour alone.
  /// @param reporter outlives the pipeline.
  /// @throws StageError when compiling it fails.
  Pipeline(PipelineParts parts, Reporter& reporter);
  ~Pipeline();

  /// Fills `runs`, `blobs`, `detections` and the frame-path `times` of `result` from
  /// `result.frame`. Frames of 16 bit, one or four channels are converted in place; a frame of
  /// another size than the last one is taken as it comes.
  /// @throws StageError when a stage throws or makes what it must not, any other std::exception
  ///   when a step between the stages fails; the pipeline can go on with the next frame.
  FrameOutcome process(FrameResult& result);

  /// Goes on where `predecessor` stands, which is not used any more: takes its tracker with all it
  /// remembers, and the light it has followed. For a pipeline that differs in other stages only.
  void continue_from(Pipeline& predecessor);

  /// The transform for the latest processed frame's size; null before the first frame. Shared
  /// because sinks still work on a frame of the old size when a new one arrives.
  const std::shared_ptr<const Field>& field() const { return field_; }
  const Palette& palette() const { return parts_.palette; }
  const PipelineParts& parts() const { return parts_; }

  /// What the latest frame's colours were multiplied by before anything judged them; null when they
  /// were taken as they came.
  const ChannelGains* channel_gains() const { return channel_gains_; }

  /// Which pixels of the latest processed frame were looked at, and which ones ever are.
  const ScanArea& scanned_area() const { return *scanned_area_; }
  const ScanArea& field_area() const { return field_area_; }

  /// The compiled table; nothing when a stage needs the picture.
  const ColorTable* color_table() const { return table_ ? &*table_ : nullptr; }
  /// The blob limits, in pixels, for the latest processed frame's size; and the scale they were
  /// made with, that of the picture's middle at the robots' tag height.
  const BlobExtractor::Limits& blob_limits_px() const { return blob_limits_px_; }
  double blob_scale_mm2_per_px() const { return blob_scale_mm2_per_px_; }
  /// The latest processed frame as the normalizer made it, valid until the next; null when there is
  /// a table.
  const cv::Mat* normalized_picture() const;
  /// Zero when there is no table.
  std::chrono::nanoseconds table_compile_time() const { return table_compile_time_; }

 private:
  class StopWatch;

  void take_size(cv::Size size);
  void make_room(FrameResult& result) const;
  void find_blobs(FrameResult& result, StopWatch& watch);
  BlobExtractor::LeftOut find_blobs_in(const ScanArea& area, const cv::Mat* labels,
                                       FrameResult& result, StopWatch& watch);
  const cv::Mat* segment_image(const FrameResult& result);
  void warn_of_short_runs(int shortest_px);

  PipelineParts parts_;
  Reporter& reporter_;
  std::optional<ColorTable> table_;
  std::chrono::nanoseconds table_compile_time_{0};
  RunScanner scanner_;
  ScanArea field_area_;
  const ScanArea* scanned_area_ = &field_area_;
  std::unique_ptr<PredictedSearch> search_;  ///< Null: the whole field in every frame.
  LightFollower light_follower_;
  const ChannelGains* channel_gains_ = nullptr;  ///< Into the follower.
  cv::Mat balanced_;  ///< The picture times the gains, for image stages.
  std::unique_ptr<ImagePath> image_path_;  ///< Used when there is no table.
  std::shared_ptr<const Field> field_;
  BlobExtractor::Limits blob_limits_px_;
  double blob_scale_mm2_per_px_ = 0.0;
  BlobExtractor blob_extractor_;
};

}  // namespace maggic
