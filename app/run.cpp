/// `maggic run`: build the pipeline, run it, show how it goes, sum up.

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "app/progress.hpp"
#include "app/summary.hpp"
#include "maggic/runner.hpp"
#include "maggic/truth_score.hpp"

namespace maggic::app {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

std::atomic<bool> stop_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

/// The first Ctrl-C ends the run in order, outputs complete; a second one kills.
void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_wanted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// Whether an output of the pipeline goes to standard output, where the summary would spoil it.
bool writes_to_stdout(const PipelineRequest& request) {
  std::vector<Mistake> notes;
  const Node document = merged_document(request, notes);
  std::vector<Node> sinks = request.extra_sinks;
  if (const Node* own = document.find("sinks")) {
    sinks.insert(sinks.end(), own->items.begin(), own->items.end());
  }
  for (const Node& sink : sinks) {
    for (const Node::Entry& entry : sink.entries) {
      const Node* path = entry.value.find("path");
      if (path != nullptr && path->scalar == "-") return true;
    }
  }
  return false;
}

/// Ends a run once it has covered `duration_s` of the source's time.
class DurationLimit {
 public:
  explicit DurationLimit(std::optional<double> duration_s) : duration_s_(duration_s) {}

  bool reached(Timestamp captured, const SourceInfo& source) {
    if (!duration_s_) return false;
    if (!first_) first_ = captured;
    // A frame stands for the time until the next one: 10 s at 60 fps are 600 frames, not 601.
    const double frame_s = source.frames_per_second > 0.0 ? 1.0 / source.frames_per_second : 0.0;
    const double covered_s = duration<double>(captured - *first_).count() + frame_s;
    return covered_s >= *duration_s_ - frame_s / 2.0;
  }

 private:
  std::optional<double> duration_s_;
  std::optional<Timestamp> first_;
};

std::optional<std::uint64_t> expected_frames(const RunOptionsGiven& options,
                                             const SourceInfo& source) {
  std::optional<std::uint64_t> total = source.frame_count;
  const auto limit = [&](std::uint64_t frames) {
    total = std::min(total.value_or(frames), frames);
  };
  if (options.frames) limit(*options.frames);
  if (options.duration_s && source.frames_per_second > 0.0) {
    limit(static_cast<std::uint64_t>(*options.duration_s * source.frames_per_second + 0.5));
  }
  return total;
}

}  // namespace

ExitCode run_command(const RunOptionsGiven& options, const CommandLine& line) {
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
  for (const Mistake& note : built.notes) {
    console.line(note.to_string(), Console::Tone::kWarning, "note: ");
  }

  end_on_signals();
  TruthScore truth;
  DurationLimit limit(options.duration_s);
  RunOptions run_options;
  run_options.max_frames = options.frames;
  run_options.realtime = options.realtime;
  const auto started = steady_clock::now();
  RunSummary summary;
  {
    Progress progress(console);
    summary = run(built, run_options, stop_wanted, reporter,
                  [&](const FrameResult& result, const RunSummary& so_far) {
                    if (result.frame.has_truth) truth.add(result.detections, result.frame.truth);
                    progress.update(result, so_far, expected_frames(options, so_far.source));
                    if (limit.reached(result.frame.captured, so_far.source)) stop_wanted = true;
                  });
  }
  const double elapsed_s = duration<double>(steady_clock::now() - started).count();
  reporter.print_totals();

  std::FILE* report = writes_to_stdout(request) ? stderr : stdout;
  fmt::print(report, "{}", summary_text(summary, truth, elapsed_s));
  std::fflush(report);
  if (!summary.clean()) {
    console.line("something failed during the run, see above", Console::Tone::kError, "error: ");
    return kFailed;
  }
  return kFine;
}

}  // namespace maggic::app
