#include "maggic/runner.hpp"

#include <algorithm>
#include <memory>
#include <vector>

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

}  // namespace

bool RunSummary::clean() const {
  return !source_failed && failed == 0 && first_error.empty() &&
         std::ranges::all_of(sinks, [](const SinkSummary& s) { return s.first_error.empty(); });
}

RunSummary run(BuiltPipeline& built, const RunOptions& options, const std::atomic<bool>& stop,
               Reporter& reporter,
               const std::function<void(const FrameResult&, const RunSummary&)>& on_frame) {
  RunSummary summary;
  try {
    summary.source = guarded(StageKind::kSource, built.source.name, "to open",
                             [&] { return built.source.stage->open(); });
  } catch (const StageError& e) {
    summary.source_failed = true;
    summary.first_error = e.what();
    return summary;
  }
  const bool live = summary.source.live || options.realtime;
  const bool paced = options.realtime && !summary.source.live;

  // Declared before the threads that use them, so they outlive those.
  FramePool pool(slots_for(built.sinks.size(), options.sink_queue_frames));
  const RunInfo info{built.pipeline->palette(), summary.source};
  std::vector<std::unique_ptr<SinkThread>> sinks;
  for (NamedStage<Sink>& sink : built.sinks) {
    sinks.push_back(
        std::make_unique<SinkThread>(sink, info, options.sink_queue_frames, reporter));
  }

  {
    Capture capture(built.source, live, paced, pool, stop);
    const auto wanted = [&] {
      return !stop && (!options.max_frames || summary.processed < *options.max_frames);
    };
    while (wanted() && !capture.finished()) {
      const FramePtr frame = capture.next(kPatience);
      if (!frame) continue;
      try {
        const FrameOutcome outcome = built.pipeline->process(frame->result);
        summary.dropped = capture.dropped();
        if (outcome == FrameOutcome::kSkipped) {
          ++summary.skipped;
          continue;
        }
      } catch (const StageError& e) {
        if (summary.failed++ == 0) summary.first_error = e.what();
        reporter.warn(e.what());
        continue;
      }
      ++summary.processed;
      summary.times.add(frame->result.times);
      frame->field = built.pipeline->field();
      for (const std::unique_ptr<SinkThread>& sink : sinks) {
        if (live) {
          sink->offer(frame);
        } else {
          sink->give(frame);
        }
      }
      if (on_frame) on_frame(frame->result, summary);
    }
    if (capture.finished() && !capture.error().empty()) {
      summary.source_failed = true;
      summary.first_error = capture.error();
      reporter.warn(capture.error());
    }
    summary.dropped = capture.dropped();
  }
  for (const std::unique_ptr<SinkThread>& sink : sinks) summary.sinks.push_back(sink->finish());
  return summary;
}

}  // namespace maggic
