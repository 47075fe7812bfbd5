/// `maggic bench`: how fast a pipeline is on this machine.

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/bench_report.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/label_picture.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/simd_target.hpp"
#include "maggic/speed_measurement.hpp"

namespace maggic::app {
namespace {

constexpr std::uint64_t kMostCompilations = 20;
constexpr std::uint64_t kFramesPerCompilation = 10;  // a look at few frames is not to take long
constexpr double kLatencySeconds = 5.0;

/// The segmenter after somebody moved a parameter of it, and what was moved.
struct ChangedSegmenter {
  StagePtr<Segmenter> stage;  ///< Null: nothing could be.
  std::string what;
};

std::optional<int> gray_threshold_of(const PipelineParts& parts) {
  const std::vector<ParameterRow> rows =
      parameter_table(parts.palette, [&](Parameters& p) { parts.segmenter.stage->describe(p); });
  const auto row = std::ranges::find(rows, "gray_threshold", &ParameterRow::path);
  if (row == rows.end()) return std::nullopt;
  int value = 0;
  const std::string& text = row->default_value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

ChangedSegmenter change_segmenter(const PipelineParts& parts, const Node& document,
                                  PluginRegistry& registry, Reporter& reporter) {
  const Node* section = document.find("segmenter");
  const std::optional<int> threshold = gray_threshold_of(parts);
  if (section != nullptr && threshold) {
    const int moved = *threshold < 255 ? *threshold + 1 : *threshold - 1;
    StagePtr<Segmenter> stage =
        segmenter_with_threshold(*section, moved, registry, {parts.palette, reporter});
    if (stage) {
      return {std::move(stage),
              fmt::format("compiled again, gray_threshold {} → {}", *threshold, moved)};
    }
  }
  return {{}, "compiled again, nothing changed"};
}

/// What to run, and where its progress is told.
class Bench {
 public:
  Bench(const BenchOptions& options, const CommandLine& line)
      : options_(options),
        request_(make_request(options.pipeline)),
        registry_(make_registry(line)),
        console_(stderr),
        reporter_(console_),
        document_(merged_document(request_, notes_)),
        built_(build()),
        source_(source_path(document_)) {
    for (const Mistake& note : built_.notes) {
      console_.line(note.to_string(), Console::Tone::kWarning, "note: ");
    }
    if (!options.json) return;
    std::vector<std::filesystem::path> inputs{request_.pipeline};
    if (request_.calibration) inputs.push_back(*request_.calibration);
    if (source_) inputs.emplace_back(*source_);
    check_report(*options.json, "--json", inputs);
  }

  ExitCode run() {
    try {
      const SpeedReport report = measure();
      console_.end_live();
      reporter_.print_totals();
      fmt::print("{}", speed_text(report));
      std::fflush(stdout);
      if (options_.json) write_file_atomically(*options_.json, speed_json(report));
    } catch (const std::exception& error) {
      console_.line(error.what(), Console::Tone::kError, "error: ");
      return kFailed;
    }
    return kFine;
  }

 private:
  BuiltPipeline build() { return build_pipeline(request_, registry_, reporter_); }

  /// The same pipeline, so many threads sharing the rows of a frame.
  BuiltPipeline build(unsigned threads) {
    PipelineRequest request = request_;
    request.assignments.push_back(fmt::format("scan.threads={}", threads));
    return build_pipeline(request, registry_, reporter_);
  }

  void tell(std::string_view phase) {
    if (console_.is_terminal()) console_.live(fmt::format("{} …", phase));
  }

  SpeedReport measure() {
    SpeedReport report;
    report.pipeline = request_.pipeline.string();
    if (request_.calibration) report.calibration = request_.calibration->string();
    report.source = source_.value_or(built_.source.name);
    report.frames = options_.frames;
    report.scan = built_.pipeline->parts().scan;
    report.machine = describe_machine();
    report.threads =
        options_.threads.value_or(std::min(report.machine.cores, BenchOptions::kMostThreads));
    report.simd_target = simd_target();

    tell("taking frames into memory");
    const FrameStore store(built_.source, {.frames = options_.frames}, reporter_);
    report.frame_size_px = store.frame_size_px();
    report.frames_from_source = store.given();

    Pipeline& pipeline = *built_.pipeline;
    tell("measuring the frame path");
    report.frame_path = measure_frame_path(pipeline, store, options_.frames);
    tell("measuring the colour table");
    measure_table(report);
    tell("measuring the throughput");
    measure_rates(store, report);
    tell("measuring the latency");
    report.latency = measure_latency(built_, store, latency_frames(store), reporter_);
    return report;
  }

  void measure_table(SpeedReport& report) {
    const ChangedSegmenter changed =
        change_segmenter(built_.pipeline->parts(), document_, registry_, reporter_);
    report.table = maggic::measure_table(*built_.pipeline,
                                         dynamic_cast<const ColorSegmenter*>(changed.stage.get()),
                                         report.threads, compilations());
    report.update = changed.what;
  }

  int compilations() const {
    const std::uint64_t wanted = 1 + options_.frames / kFramesPerCompilation;
    return static_cast<int>(std::min(wanted, kMostCompilations));
  }

  void measure_rates(const FrameStore& store, SpeedReport& report) {
    const auto rate_of = [&](const std::vector<BuiltPipeline>& built) {
      std::vector<Pipeline*> pipelines;
      pipelines.reserve(built.size());
      for (const BuiltPipeline& one : built) pipelines.push_back(one.pipeline.get());
      return measure_throughput(pipelines, store, options_.frames);
    };
    std::vector<BuiltPipeline> alone;
    alone.push_back(build(1));
    report.throughput.one_thread_fps = rate_of(alone);
    report.throughput.threads_fps = report.throughput.one_thread_fps;
    report.throughput.pipelines_fps = report.throughput.one_thread_fps;
    if (report.threads == 1) return;
    std::vector<BuiltPipeline> shared;
    shared.push_back(build(report.threads));
    report.throughput.threads_fps = rate_of(shared);
    while (alone.size() < report.threads) alone.push_back(build(1));
    report.throughput.pipelines_fps = rate_of(alone);
  }

  /// No more than a slow source gives in a few seconds.
  std::uint64_t latency_frames(const FrameStore& store) const {
    const double period_s = std::chrono::duration<double>(store.period()).count();
    const auto in_time = static_cast<std::uint64_t>(kLatencySeconds / period_s);
    return std::clamp<std::uint64_t>(in_time, 1, options_.frames);
  }

  const BenchOptions& options_;
  PipelineRequest request_;
  PluginRegistry registry_;
  Console console_;
  ConsoleReporter reporter_;
  std::vector<Mistake> notes_;  ///< Told with those of the built pipeline.
  Node document_;
  BuiltPipeline built_;
  std::optional<std::string> source_;
};

}  // namespace

ExitCode bench_command(const BenchOptions& options, const CommandLine& line) {
  return Bench(options, line).run();
}

}  // namespace maggic::app
