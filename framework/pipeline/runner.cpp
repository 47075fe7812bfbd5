#include "maggic/runner.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "pipeline/capture.hpp"
#include "pipeline/sink_thread.hpp"
#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

constexpr std::chrono::milliseconds kPatience{50};

/// Enough slots that no queue ever starves the capture: one being read, one waiting or read ahead
/// twice, one in the frame path, and what every sink may hold.
std::size_t slots_for(std::size_t sinks, std::size_t queue_frames) {
  return 4 + sinks * (queue_frames + 1);
}

/// Whether the frames taken cover the wanted time of their source.
class DurationLimit {
 public:
  DurationLimit(std::optional<double> duration_s, double frames_per_second)
      : duration_s_(duration_s),
        frame_s_(frames_per_second > 0.0 ? 1.0 / frames_per_second : 0.0) {}

  void add(Timestamp captured) {
    // A recording that jumps back goes on from there: what it covered before still counts.
    if (last_ && captured > *last_) covered_ += captured - *last_;
    last_ = captured;
  }

  bool reached() const {
    if (!duration_s_ || !last_) return false;
    // A frame stands for the time until the next one: 10 s at 60 fps are 600 frames, not 601.
    const double covered_s = std::chrono::duration<double>(covered_).count() + frame_s_;
    return covered_s >= *duration_s_ - frame_s_ / 2.0;
  }

 private:
  const std::optional<double> duration_s_;
  const double frame_s_;
  std::optional<Timestamp> last_;
  Timestamp covered_{0};
};

}  // namespace

bool RunSummary::clean() const {
  return !source_failed && failed == 0 && first_error.empty() &&
         std::ranges::all_of(sinks, [](const SinkSummary& s) { return s.first_error.empty(); });
}

RunSummary run(BuiltPipeline& built, const RunOptions& options, const std::atomic<bool>& stop,
               Reporter& reporter,
               const std::function<void(const FrameResult&, const RunSummary&)>& on_frame) {
  RunSummary summary;
  summary.table_compile_time = built.pipeline->table_compile_time();
  try {
    summary.source = guarded(StageKind::kSource, built.source.name, "to open",
                             [&] { return built.source.stage->open(); });
  } catch (const std::exception& e) {
    summary.source_failed = true;
    summary.first_error = e.what();
    return summary;
  }
  const bool live = summary.source.live || options.realtime;
  const bool paced = options.realtime && !summary.source.live;

  // Declared before the threads that use them, so they outlive those.
  FramePool pool(slots_for(built.sinks.size(), options.sink_queue_frames));
  // A copy: whoever runs it may exchange the pipeline between two frames.
  const Palette palette = built.pipeline->palette();
  const RunInfo info{palette, summary.source};
  std::vector<std::unique_ptr<SinkThread>> sinks;
  for (NamedStage<Sink>& sink : built.sinks) {
    sinks.push_back(std::make_unique<SinkThread>(sink, info, options.sink_queue_frames, reporter));
  }

  {
    Capture capture(built.source, live, paced, pool, stop);
    const auto count_failed = [&](const std::string& message) {
      if (summary.failed++ == 0) summary.first_error = message;
      tell(reporter, message);
    };
    const auto take = [&](const FramePtr& frame) {
      try {
        const FrameOutcome outcome = built.pipeline->process(frame->result);
        summary.dropped = capture.dropped();
        if (outcome == FrameOutcome::kSkipped) {
          ++summary.skipped;
          return;
        }
      } catch (const StageError& e) {
        count_failed(e.what());
        return;
      } catch (const std::exception& e) {
        count_failed(fmt::format("frame {} failed: {}", frame->result.frame.sequence, e.what()));
        return;
      }
      ++summary.processed;
      summary.times.add(frame->result.times);
      frame->field = built.pipeline->field();
      for (const std::unique_ptr<SinkThread>& sink : sinks) {
        if (live) {
          sink->offer(frame);
        } else {
          sink->give(frame, stop, options.patience_after_stop);
        }
      }
      if (on_frame) on_frame(frame->result, summary);
    };

    DurationLimit duration_limit(options.max_duration_s, summary.source.frames_per_second);
    const auto wanted = [&] {
      return !stop && !duration_limit.reached() &&
             (!options.max_frames || summary.taken() < *options.max_frames);
    };
    while (wanted() && !capture.finished()) {
      const FramePtr frame = capture.next(kPatience);
      if (!frame) continue;
      take(frame);
      duration_limit.add(frame->result.frame.captured);
    }
    if (capture.finished() && !capture.error().empty()) {
      summary.source_failed = true;
      summary.first_error = capture.error();
      tell(reporter, capture.error());
    }
    summary.dropped = capture.dropped();
  }
  // All at once, so that one that hangs does not keep the others from completing their outputs.
  for (const std::unique_ptr<SinkThread>& sink : sinks) sink->close();
  for (const std::unique_ptr<SinkThread>& sink : sinks) summary.sinks.push_back(sink->finish());
  return summary;
}

}  // namespace maggic
