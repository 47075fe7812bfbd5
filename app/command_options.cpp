#include "app/command_options.hpp"

#include <charconv>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace maggic::app {
namespace {

/// CLI11's own range check prints the largest double in full. This one also rewrites the number in
/// plain decimals, because CLI11 would read 010 as octal.
template <class Number>
CLI::Validator within(Number min, Number max, std::string_view expected) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        Number number{};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, number);
        const bool is_usable =
            error == std::errc() && stop == end && number >= min && number <= max;
        if (!is_usable) return fmt::format("found '{}', expected {}", text, expected);
        text = fmt::format("{}", number);
        return {};
      },
      "");
}

template <class Number>
CLI::Validator above_zero(std::string_view expected) {
  // The smallest of a floating-point type is its smallest above 0, that of a counting type is 0.
  constexpr Number kSmallest =
      std::is_integral_v<Number> ? Number{1} : std::numeric_limits<Number>::min();
  return within(kSmallest, std::numeric_limits<Number>::max(), expected);
}

void add_overrides(CLI::App& command, PipelineOptions& options) {
  command.add_option("--source", options.source,
                     "Camera number, file, folder, glob, URL or 'synthetic' in place of the "
                     "pipeline's source");
  command
      .add_option("--set", options.assignments,
                  "Change one value: path.to.key=value; may be given several times")
      ->allow_extra_args(false);
}

void add_calibration(CLI::App& command, PipelineOptions& options) {
  command.add_option("--calibration", options.calibration,
                     "Venue numbers laid over the pipeline (YAML file)");
}

void add_pipeline(CLI::App& command, PipelineOptions& options) {
  command.add_option("pipeline", options.pipeline, "Pipeline file or name")->required();
  add_overrides(command, options);
  add_calibration(command, options);
}

void add_frames(CLI::App& command, std::optional<std::uint64_t>& frames) {
  command.add_option("--frames", frames, "End after so many frames")
      ->transform(above_zero<std::uint64_t>("a whole number above 0"));
}

void add_why(CLI::App& command, WhyOptions& why) {
  CLI::Option* points =
      command
          .add_option("--why", why.points,
                      "Say which stage dropped what lies at this pixel, X,Y, and by which rule; "
                      "may be given several times")
          ->allow_extra_args(false);
  command.add_option("--why-frame", why.frame, "… in this frame (default: the last one)")
      ->transform(within<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max(),
                                        "a frame's number, from 0"))
      ->needs(points);
}

/// The options live with the function that hands them over.
template <class Options, class Describe>
OfferedCommand offer(CLI::App& app, const char* name, const char* what, Describe describe) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, what);
  describe(*command, *options);
  return {command, [options] { return Command(std::move(*options)); }};
}

void describe_run(CLI::App& command, RunOptionsGiven& run) {
  add_pipeline(command, run.pipeline);
  add_frames(command, run.frames);
  command
      .add_option("--duration", run.duration_s, "End after so many seconds of the source's time")
      ->transform(above_zero<double>("a number of seconds above 0"));
  command.add_option("--output", run.output, "Write JSON Lines here ('-': standard output)");
  command.add_option("--video", run.video, "Write an annotated video here (.mp4)");
  command.add_flag("--realtime", run.realtime, "Play a recording at its own pace, as if live");
  add_why(command, run.why);
}

void describe_studio(CLI::App& command, StudioOptions& studio) {
  add_pipeline(command, studio.pipeline);
  command.add_option("--port", studio.port, "Port of the page; 0: any free one")
      ->transform(within(0, 65535, "a port, 0 to 65535"))
      ->capture_default_str();
  command
      .add_option("--listen", studio.listen,
                  "Address to serve the page on; other than this machine's own, it asks for the "
                  "token that is printed")
      ->capture_default_str();
}

void describe_score(CLI::App& command, ScoreOptions& score) {
  add_pipeline(command, score.pipeline);
  command.add_option("--truth", score.truth,
                     "Annotation file (JSON); left out: what the source itself knows");
  add_frames(command, score.frames);
  command.add_option("--json", score.json, "Write every figure here");
  command.add_option("--require", score.require,
                     "Fail below these figures, such as seen=99,false=0");
  add_why(command, score.why);
}

void describe_compare(CLI::App& command, CompareOptions& compare) {
  command.add_option("pipelines", compare.pipelines, "Two or more pipeline files or names")
      ->required();
  add_overrides(command, compare.common);
  command
      .add_option("--calibration", compare.calibrations,
                  "Venue numbers: one file for all pipelines, or one for each in their order")
      ->allow_extra_args(false);
  command.add_option("--truth", compare.truth, "Annotation file (JSON)");
  add_frames(command, compare.frames);
  command.add_option("-o,--output", compare.output, "Folder of the report (default: compare)");
  command.add_option("--json", compare.json, "Write every figure here");
  command
      .add_option("--thresholds", compare.thresholds,
                  "Gray thresholds shown in the report, such as 20,40,60")
      ->delimiter(',')
      ->transform(within(0, 255, "whole numbers from 0 to 255"));
}

void describe_bench(CLI::App& command, BenchOptions& bench) {
  command.add_option("pipeline", bench.pipeline.pipeline,
                     "Pipeline file or name (default: maggic_3v3)");
  add_overrides(command, bench.pipeline);
  add_calibration(command, bench.pipeline);
  command.add_option("--frames", bench.frames, "Measure so many frames (default: 300)")
      ->transform(within<std::uint64_t>(1, 1'000'000, "a whole number from 1 to 1000000"));
  command
      .add_option("--threads", bench.threads,
                  "Threads of what is measured with several (default: one per core)")
      ->transform(within(1U, BenchOptions::kMostThreads, "a whole number from 1 to 64"));
  command.add_option("--json", bench.json, "Write every figure here");
}

void describe_sweep(CLI::App& command, SweepOptions& sweep) {
  add_pipeline(command, sweep.pipeline);
  command
      .add_option("--images", sweep.images,
                  "Folder of pictures, each with its labels beside it: NAME.png, NAME.labels.png")
      ->required();
  command.add_option("-o,--output", sweep.output, "Folder of plots and tables (default: sweep)");
  command
      .add_option("--normalizers", sweep.normalizers,
                  "Normalizers to compare, such as none,weighted (default: all)")
      ->delimiter(',');
  command
      .add_option("--share", sweep.share_percent,
                  "Percent of every colour's pixels a good threshold keeps (default: 90)")
      ->transform(within(0.0, 100.0, "a number from 0 to 100"));
}

void describe_calibrate(CLI::App& command, CalibrateOptions& calibrate) {
  add_pipeline(command, calibrate.pipeline);
  command.add_option("-o,--output", calibrate.output, "Calibration file to write")->required();
  command.add_option("--frames", calibrate.frames, "Look at so many frames (default: 100)")
      ->transform(above_zero<std::uint64_t>("a whole number above 0"));
  command
      .add_option("--corners", calibrate.corners,
                  "The field's corners in the picture, x,y each: top left, top right, bottom "
                  "right, bottom left (default: found)")
      ->expected(4);
  command.add_option("--threshold", calibrate.gray_threshold, "Gray threshold (default: found)")
      ->transform(within(0, 255, "a whole number from 0 to 255"));
}

void describe_import(CLI::App& command, ImportOptions& import) {
  command
      .add_option("files", import.files,
                  "Calibrations of other programs: MaggicSegmentation.txt, YUV boxes (XML), "
                  "fieldLimits.json")
      ->required();
  command.add_option("-o,--output", import.output, "Calibration file to write")->required();
  command.add_option("--image-size", import.image_size,
                     "Size of the picture the corners of fieldLimits.json were taken in, such as "
                     "640x480");
}

void describe_check(CLI::App& command, CheckOptions& check) {
  command.add_option("pipelines", check.pipelines, "Pipeline files or names")->required();
  add_overrides(command, check.common);
  add_calibration(command, check.common);
}

void describe_describe(CLI::App& command, DescribeOptions& describe) {
  command.add_option("names", describe.names, "Plugin or section names; none: everything");
}

void describe_new(CLI::App& command, NewOptions& created) {
  command.add_option("kind", created.kind, "source, normalizer, segmenter, tracker or sink")
      ->required();
  command.add_option("name", created.name, "Name of the plugin")->required();
  command.add_option("folder", created.folder, "Folder to write it into")->required();
}

OfferedCommand offer_plot(CLI::App& app) {
  auto options = std::make_shared<PlotNormalizerOptions>();
  CLI::App* plot = app.add_subcommand("plot", "Draw what a plugin does");
  plot->require_subcommand(1);
  CLI::App* normalizer =
      plot->add_subcommand("normalizer", "Where a normalizer moves colours, as a vector field");
  normalizer->add_option("name", options->normalizer, "Name of the normalizer")->required();
  normalizer->add_option("-o,--output", options->output, "SVG file (default: NAME.svg)");
  return {plot, [options] { return Command(std::move(*options)); }};
}

}  // namespace

std::vector<OfferedCommand> offer_commands(CLI::App& app) {
  return {
      offer<RunOptionsGiven>(app, "run", "Run a pipeline on its source", describe_run),
      offer<StudioOptions>(app, "studio", "Watch and tune a running pipeline from a browser",
                           describe_studio),
      offer<CalibrateOptions>(app, "calibrate", "Find a venue's numbers from a few frames",
                              describe_calibrate),
      offer<ScoreOptions>(app, "score", "Run a pipeline and compare with the truth",
                          describe_score),
      offer<CompareOptions>(app, "compare", "Run pipelines side by side on the same frames",
                            describe_compare),
      offer<BenchOptions>(app, "bench",
                          "Measure how fast a pipeline is, beside what the machine can do",
                          describe_bench),
      offer<SweepOptions>(app, "sweep",
                          "Share of pixels labelled right, against the gray threshold",
                          describe_sweep),
      offer_plot(app),
      offer<ImportOptions>(app, "import", "Turn another program's calibration into one of ours",
                           describe_import),
      offer<CheckOptions>(app, "check",
                          "Find every mistake in pipeline files; with --source, colours that "
                          "lie badly too",
                          describe_check),
      offer<PluginsOptions>(app, "plugins",
                            "List the plugins found, and files refused with the reason",
                            [](CLI::App&, PluginsOptions&) {}),
      offer<DescribeOptions>(app, "describe",
                             "Show the parameters of plugins and pipeline sections (field, blobs, light, scan)",
                             describe_describe),
      offer<NewOptions>(app, "new", "Write the folder of a new, working plugin with its test",
                        describe_new),
  };
}

}  // namespace maggic::app
