#include "maggic/side_by_side.hpp"

#include <exception>
#include <string>

#include <fmt/format.h>

#include "maggic/frame_conversion.hpp"
#include "pipeline/capture.hpp"
#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

constexpr std::chrono::milliseconds kPatience{50};
constexpr std::size_t kSlots = 4;  // one being read, two read ahead, one in work

/// The pipelines, what each made of the latest frame, and how each does.
class Runners {
 public:
  Runners(std::span<Pipeline* const> pipelines, Reporter& reporter)
      : pipelines_(pipelines),
        reporter_(reporter),
        results_(pipelines.size()),
        shown_(pipelines.size()),
        summaries_(pipelines.size()) {
    for (std::size_t i = 0; i < pipelines.size(); ++i) {
      summaries_[i].table_compile_time = pipelines[i]->table_compile_time();
    }
  }

  std::vector<RunSummary>& summaries() { return summaries_; }
  std::span<const FrameResult* const> results() const { return shown_; }

  /// @return whether the frame was a usable picture.
  bool take(FrameResult& read) {
    if (const auto unusable = convert_to_bgr8(read.frame.bgr)) {
      tell(reporter_, fmt::format("a frame was skipped: {}", *unusable));
      for (RunSummary& summary : summaries_) ++summary.skipped;
      return false;
    }
    for (std::size_t turn = 0; turn < pipelines_.size(); ++turn) {
      process((first_ + turn) % pipelines_.size(), read);
    }
    first_ = (first_ + 1) % pipelines_.size();
    return true;
  }

 private:
  void process(std::size_t i, const FrameResult& read) {
    FrameResult& result = results_[i];
    RunSummary& summary = summaries_[i];
    result.frame = read.frame;  // shares the picture
    shown_[i] = nullptr;
    try {
      pipelines_[i]->process(result);
    } catch (const std::exception& e) {
      if (summary.failed++ == 0) summary.first_error = e.what();
      tell(reporter_, e.what());
      return;
    }
    result.times[Step::kRead] = read.times[Step::kRead];
    ++summary.processed;
    summary.times.add(result.times);
    shown_[i] = &result;
  }

  std::span<Pipeline* const> pipelines_;
  Reporter& reporter_;
  std::vector<FrameResult> results_;
  std::vector<const FrameResult*> shown_;
  std::vector<RunSummary> summaries_;
  std::size_t first_ = 0;
};

}  // namespace

std::vector<RunSummary> run_side_by_side(NamedStage<Source>& source,
                                         std::span<Pipeline* const> pipelines,
                                         std::optional<std::uint64_t> max_frames,
                                         const std::atomic<bool>& stop, Reporter& reporter,
                                         const OnFrames& on_frames) {
  Runners runners(pipelines, reporter);
  std::vector<RunSummary>& summaries = runners.summaries();
  const auto source_failed = [&](const std::string& message) {
    for (RunSummary& summary : summaries) {
      summary.source_failed = true;
      summary.first_error = message;
    }
  };
  SourceInfo info;
  try {
    info =
        guarded(StageKind::kSource, source.name, "to open", [&] { return source.stage->open(); });
  } catch (const std::exception& e) {
    source_failed(e.what());
    return summaries;
  }
  for (RunSummary& summary : summaries) summary.source = info;

  FramePool pool(kSlots);  // outlives the thread that fills it
  Capture capture(source, info.live, false, pool, stop);
  while (!stop && !capture.finished() && (!max_frames || summaries.front().taken() < *max_frames)) {
    const FramePtr frame = capture.next(kPatience);
    if (!frame) continue;
    const bool is_usable = runners.take(frame->result);
    for (RunSummary& summary : summaries) summary.dropped = capture.dropped();
    if (is_usable && on_frames) on_frames(runners.results(), summaries);
  }
  if (capture.finished() && !capture.error().empty()) {
    source_failed(capture.error());
    tell(reporter, capture.error());
  }
  return summaries;
}

}  // namespace maggic
