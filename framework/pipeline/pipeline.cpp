#include "maggic/pipeline.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "maggic/field_area.hpp"
#include "maggic/frame_conversion.hpp"
#include "pipeline/image_path.hpp"
#include "pipeline/stage_guard.hpp"
#include "search/predicted_search.hpp"

namespace maggic {
namespace {

// More than two teams of any league; if there are more of them the vector grows.
constexpr std::size_t kUsualRobots = 32;

}  // namespace

/// Gives the time since construction, or since the last `lap`.
class Pipeline::StopWatch {
 public:
  std::chrono::nanoseconds lap() {
    const auto now = std::chrono::steady_clock::now();
    return now - std::exchange(last_, now);
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void BlobParameters::describe(Parameters& p) {
  p.number({"min_area_mm2", "smaller blobs are noise and left out", "mm²"}, min_area_mm2,
           {0.0, 1e6});
  p.number({"max_area_mm2", "larger blobs are no tag and no ball and left out", "mm²"},
           max_area_mm2, {0.0, 1e9});
  p.integer({"max_blobs", "at most so many blobs a frame, the largest; bounds the work on noise"},
            max_blobs, {1, 1'000'000});
  p.integer({"max_runs",
             "at most so many stretches of one colour along a row a frame, the longest; bounds the "
             "work on noise"},
            max_runs, {1, 100'000'000});
  p.check("max_area_mm2", max_area_mm2 >= min_area_mm2,
          fmt::format("max_area_mm2 {} is below min_area_mm2 {}: expected at least as much",
                      max_area_mm2, min_area_mm2));
}

Pipeline::Pipeline(PipelineParts parts, Reporter& reporter)
    : parts_(std::move(parts)),
      reporter_(reporter),
      scanner_(static_cast<unsigned>(parts_.scan.threads)),
      light_follower_(parts_.light),
      image_path_(std::make_unique<ImagePath>()) {
  if (parts_.scan.search == ScanParameters::Search::kPredicted) {
    search_ = std::make_unique<PredictedSearch>(parts_.scan.unseen_frames);
  }
  const auto* normalizer = dynamic_cast<const ColorNormalizer*>(parts_.normalizer.stage.get());
  const auto* segmenter = dynamic_cast<const ColorSegmenter*>(parts_.segmenter.stage.get());
  if (normalizer == nullptr || segmenter == nullptr) return;
  StopWatch watch;
  guarded(StageKind::kSegmenter, parts_.segmenter.name, "while its colour table was compiled",
          [&] { table_ = ColorTable::compile(*normalizer, *segmenter, parts_.palette.size()); });
  scanner_.set_table(*table_);
  table_compile_time_ = watch.lap();
}

Pipeline::~Pipeline() = default;

FrameOutcome Pipeline::process(FrameResult& result) {
  result.runs.clear();
  result.blobs.clear();
  result.detections.clear();
  result.detections.sequence = result.frame.sequence;
  result.detections.captured = result.frame.captured;
  for (const Step step : {Step::kSegment, Step::kBlobs, Step::kTrack}) {
    result.times[step] = std::chrono::nanoseconds(0);
  }

  StopWatch watch;
  if (const std::optional<std::string> unusable = convert_to_bgr8(result.frame.bgr)) {
    reporter_.warn(fmt::format("a frame was skipped: {}", *unusable));
    return FrameOutcome::kSkipped;
  }
  take_size(result.frame.bgr.size());
  make_room(result);
  find_blobs(result, watch);
  result.times[Step::kBlobs] += watch.lap();

  const TrackerInput input{result.frame.sequence, result.frame.captured, result.blobs, *field_};
  guarded(StageKind::kTracker, parts_.tracker.name, AtFrame{result.frame.sequence},
          [&] { parts_.tracker.stage->track(input, result.detections); });
  if (search_) search_->remember(result.detections);
  result.times[Step::kTrack] = watch.lap();
  return FrameOutcome::kProcessed;
}

void Pipeline::continue_from(Pipeline& predecessor) {
  std::swap(parts_.tracker, predecessor.parts_.tracker);
  std::swap(light_follower_, predecessor.light_follower_);
  // Into the follower, whose place has changed.
  channel_gains_ = nullptr;
}

void Pipeline::warn_of_short_runs(int shortest_px) {
  fmt::memory_buffer message;  // holds this much without allocating
  fmt::format_to(std::back_inserter(message),
                 "more runs than blobs.max_runs: those shorter than {} px were left out",
                 shortest_px);
  reporter_.warn({message.data(), message.size()});
}

const cv::Mat* Pipeline::normalized_picture() const {
  return table_ ? nullptr : &image_path_->normalized();
}

void Pipeline::take_size(cv::Size size) {
  if (field_ && field_->frame_size_px() == size) return;
  auto field = std::make_shared<const Field>(parts_.field, size);
  const cv::Point2d middle_px((size.width - 1) / 2.0, (size.height - 1) / 2.0);
  blob_scale_mm2_per_px_ = field->mm2_per_px2(middle_px, field->robot_height_mm());
  blob_limits_px_.min_area_px = parts_.blobs.min_area_mm2 / blob_scale_mm2_per_px_;
  blob_limits_px_.max_area_px = parts_.blobs.max_area_mm2 / blob_scale_mm2_per_px_;
  blob_limits_px_.max_blobs = static_cast<std::size_t>(parts_.blobs.max_blobs);
  blob_limits_px_.max_runs = static_cast<std::size_t>(parts_.blobs.max_runs);
  field_area_ = maggic::field_area(*field, parts_.scan.margin_mm);
  if (search_) search_->forget();
  field_ = std::move(field);
}

// At once as much as may be needed: a slot that is seldom used would have to grow long after the
// others did. Pages that are never written cost nothing.
void Pipeline::make_room(FrameResult& result) const {
  const std::size_t pixels = result.frame.bgr.total();
  result.runs.reserve(std::min(blob_limits_px_.max_runs, pixels));
  result.blobs.reserve(std::min({blob_limits_px_.max_blobs, blob_limits_px_.max_runs, pixels}));
  result.detections.robots.reserve(kUsualRobots);
}

void Pipeline::find_blobs(FrameResult& result, StopWatch& watch) {
  channel_gains_ = light_follower_.look(result.frame.bgr, *field_, result.frame.captured);
  const cv::Mat* labels = table_ ? nullptr : segment_image(result);
  if (search_) {
    scanned_area_ = search_->plan(result.frame.captured, *field_, field_area_);
    if (scanned_area_ != nullptr) {
      const BlobExtractor::LeftOut left_out = find_blobs_in(*scanned_area_, labels, result, watch);
      const bool is_whole = left_out.blobs == 0 && left_out.runs_shorter_than_px <= 1;
      if (is_whole && search_->accept(result.blobs)) return;
    }
  }
  scanned_area_ = &field_area_;
  const BlobExtractor::LeftOut left_out = find_blobs_in(field_area_, labels, result, watch);
  if (left_out.runs_shorter_than_px > 1) warn_of_short_runs(left_out.runs_shorter_than_px);
  if (left_out.blobs > 0) {
    reporter_.warn("more blobs than blobs.max_blobs: the smallest were left out");
  }
}

BlobExtractor::LeftOut Pipeline::find_blobs_in(const ScanArea& area, const cv::Mat* labels,
                                               FrameResult& result, StopWatch& watch) {
  if (labels != nullptr) {
    scanner_.scan_labels(*labels, area, result.runs);
  } else {
    scanner_.scan(result.frame.bgr, area, channel_gains_, result.runs);
  }
  result.times[Step::kSegment] += watch.lap();
  const BlobExtractor::LeftOut left_out =
      blob_extractor_.extract(result.runs, blob_limits_px_, result.blobs);
  result.times[Step::kBlobs] += watch.lap();
  return left_out;
}

const cv::Mat* Pipeline::segment_image(const FrameResult& result) {
  const AtFrame when{result.frame.sequence};
  if (channel_gains_ != nullptr) apply(*channel_gains_, result.frame.bgr, balanced_);
  const cv::Mat& bgr = channel_gains_ != nullptr ? balanced_ : result.frame.bgr;
  guarded(StageKind::kNormalizer, parts_.normalizer.name, when,
          [&] { image_path_->normalize(bgr, *parts_.normalizer.stage); });
  return &guarded(
      StageKind::kSegmenter, parts_.segmenter.name, when, [&]() -> const cv::Mat& {
        return image_path_->segment(bgr, *parts_.segmenter.stage, parts_.palette.size());
      });
}

}  // namespace maggic
