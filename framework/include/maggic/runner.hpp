#pragma once
/// The run loop: capture thread → frame path → sink threads.
///
/// Live sources: newest frame wins, dropped frames are counted; sinks that cannot keep up lose
/// frames, counted. Recorded sources: nothing is dropped anywhere; a slow sink slows the run.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "maggic/frame_result.hpp"
#include "maggic/pipeline_builder.hpp"
#include "maggic/step_statistics.hpp"

namespace maggic {

struct RunOptions {
  /// Stop after so many frames were taken: see RunSummary::taken.
  std::optional<std::uint64_t> max_frames;
  /// Stop once the frames taken cover so much of the source's time, by `Frame::captured`.
  std::optional<double> max_duration_s;
  bool realtime = false;  ///< Treat a recorded source as a live one, at its own pace.
  std::size_t sink_queue_frames = 8;
  /// How long, once the run is to stop, a recorded frame waits for room with a sink that hangs.
  std::chrono::milliseconds patience_after_stop{2000};
};

/// What happened to one sink.
struct SinkSummary {
  std::string name;
  std::uint64_t written = 0;
  std::uint64_t dropped = 0;  ///< The queue was full: live, or when the run was stopped.
  std::uint64_t failed = 0;   ///< `write` threw.
  std::string first_error;    ///< Empty when open, write and close all went well.
};

/// State of a run, during it and at its end.
struct RunSummary {
  SourceInfo source;
  std::uint64_t processed = 0;
  std::uint64_t dropped = 0;  ///< Captured but never processed (live).
  std::uint64_t skipped = 0;  ///< Not a usable picture.
  std::uint64_t failed = 0;   ///< The frame path threw.
  std::string first_error;    ///< Of the frame path or the source.
  bool source_failed = false; ///< The source could not be opened or threw while reading.
  std::vector<SinkSummary> sinks;
  StepStatistics times;
  /// Of the colour table, before the run; zero when there is none.
  std::chrono::nanoseconds table_compile_time{0};

  /// Frames that entered the frame path, whatever became of them.
  std::uint64_t taken() const { return processed + skipped + failed; }
  /// True when nothing failed: the program's exit code 0.
  bool clean() const;
};

/// Runs a built pipeline to the source's end, to a limit of `options`, or until `stop` becomes
/// true.
/// @param on_frame called on the frame path's thread after each processed frame (detections are
///   in `result`); keep it short. May be empty. It may put another pipeline, with the same palette,
///   into `built.pipeline`: the next frame goes through that one.
/// @throws nothing of a stage or the frame path: all of that is in the summary.
RunSummary run(BuiltPipeline& built, const RunOptions& options, const std::atomic<bool>& stop,
               Reporter& reporter,
               const std::function<void(const FrameResult&, const RunSummary&)>& on_frame = {});

}  // namespace maggic
