/// `maggic run`: build the pipeline, run it, show how it goes, sum up.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>

#include <fmt/format.h>

#include "app/border_notes.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_notes.hpp"
#include "app/pipeline_options.hpp"
#include "app/progress.hpp"
#include "app/stop_signals.hpp"
#include "app/summary.hpp"
#include "app/why.hpp"
#include "maggic/runner.hpp"
#include "maggic/scorecard.hpp"

namespace maggic::app {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

/// Frames the source will give until its end or the end of the wanted duration, when known.
std::optional<std::uint64_t> expected_frames(const RunOptionsGiven& options,
                                             const SourceInfo& source) {
  std::optional<std::uint64_t> total = source.frame_count;
  const auto limit = [&](std::uint64_t frames) {
    total = std::min(total.value_or(frames), frames);
  };
  if (options.duration_s && source.frames_per_second > 0.0) {
    limit(static_cast<std::uint64_t>(*options.duration_s * source.frames_per_second + 0.5));
  }
  return total;
}

ExitCode run_and_report(BuiltPipeline& built, const RunOptionsGiven& options, std::FILE* report,
                        std::atomic<bool>& stop, Console& console, ConsoleReporter& reporter,
                        Why& why) {
  Found found;
  Scorecard truth;
  BlobColors blob_colors;
  RunOptions run_options;
  run_options.max_frames = options.frames;
  run_options.max_duration_s = options.duration_s;
  run_options.realtime = options.realtime;
  const auto started = steady_clock::now();
  RunSummary summary;
  {
    Progress progress(console, options.frames);
    summary = run(built, run_options, stop, reporter,
                  [&](const FrameResult& result, const RunSummary& so_far) {
                    found.add(result.detections);
                    if (result.frame.has_truth) {
                      truth.add(result.detections, scene_of(result.frame.truth),
                                *built.pipeline->field());
                    }
                    blob_colors.offer(result, built.pipeline->channel_gains());
                    why.look(*built.pipeline, result, stop);
                    progress.update(result, so_far, expected_frames(options, so_far.source));
                  });
  }
  const double elapsed_s = duration<double>(steady_clock::now() - started).count();
  reporter.print_totals();
  print_border_notes(*built.pipeline, blob_colors, console);

  fmt::print(report, "{}", summary_text(summary, found, truth, elapsed_s));
  std::fflush(report);
  const ExitCode asked = why.print(report, console);
  if (!summary.clean()) {
    console.line("something failed during the run, see above", Console::Tone::kError, "error: ");
    return kFailed;
  }
  if (summary.taken() == 0) {
    console.line("no frame ever came from the source", Console::Tone::kError, "error: ");
    return kFailed;
  }
  return asked;
}

}  // namespace

ExitCode run_command(const RunOptionsGiven& options, const CommandLine& line) {
  Why why(options.why);
  PipelineRequest request = make_request(options.pipeline);
  if (options.output) {
    request.extra_sinks.push_back(sink_node("jsonl", *options.output, "--output"));
  }
  if (options.video) {
    request.extra_sinks.push_back(sink_node("overlay_video", *options.video, "--video"));
  }
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  BuiltPipeline built = build_pipeline(request, registry, reporter);
  const Node document = checked_document(request);
  // The summary would spoil what is written there.
  const bool stdout_taken = writes_to_stdout(document);
  print_notes(built, options.pipeline, request, console);

  std::atomic<bool>& stop = stop_on_signals();
  try {
    return run_and_report(built, options, stdout_taken ? stderr : stdout, stop, console, reporter,
                          why);
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
}

}  // namespace maggic::app
