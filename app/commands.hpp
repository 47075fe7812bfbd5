#pragma once
/// What the program can be asked to do: one option struct and one function a sub-command.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace maggic::app {

/// What the program answers to its caller.
enum ExitCode : int {
  kFine = 0,
  kFailed = 1,   ///< Something failed during the run; outputs may be incomplete.
  kMistake = 2,  ///< The command line or a configuration file is wrong, or the pipeline cannot be
                 ///< built; nothing was run.
};

/// A pipeline with what the command line lays over it.
struct PipelineOptions {
  std::string pipeline;                    ///< A file, or the name of a shipped pipeline.
  std::optional<std::string> source;       ///< See source_argument.hpp.
  std::optional<std::string> calibration;  ///< A file, or the name of a shipped calibration.
  std::vector<std::string> assignments;    ///< `path.to.key=value`
};

/// Points whose way through the stages is to be told; see why.hpp.
struct WhyOptions {
  std::vector<std::string> points;     ///< `X,Y` each, pixels.
  std::optional<std::uint64_t> frame;  ///< Left out: the last one.
};

struct RunOptionsGiven {
  PipelineOptions pipeline;
  std::optional<std::uint64_t> frames;
  std::optional<double> duration_s;   ///< Of capture time, so a recording may take less.
  std::optional<std::string> output;  ///< JSON Lines; `-` is standard output.
  std::optional<std::string> video;
  bool realtime = false;
  WhyOptions why;
};

struct StudioOptions {
  PipelineOptions pipeline;
  std::string listen = "127.0.0.1";  ///< Numeric address or name of this machine.
  int port = 8642;                   ///< 0: any free one.
};

struct CheckOptions {
  std::vector<std::string> pipelines;
  PipelineOptions common;  ///< Its `pipeline` is not used.
};

/// Both `score` and what else compares with the truth.
struct ScoreOptions {
  PipelineOptions pipeline;
  std::optional<std::filesystem::path> truth;  ///< Left out: the source's own.
  std::optional<std::uint64_t> frames;
  std::optional<std::filesystem::path> json;
  std::optional<std::string> require;  ///< `seen=99,false=0,…`
  WhyOptions why;
};

struct CompareOptions {
  std::vector<std::string> pipelines;     ///< At least two.
  std::vector<std::string> calibrations;  ///< None, one for all, or one each.
  PipelineOptions common;                 ///< Its `pipeline` and `calibration` are not used.
  std::optional<std::filesystem::path> truth;
  std::optional<std::uint64_t> frames;
  std::optional<std::filesystem::path> json;
  std::filesystem::path output = "compare";  ///< Folder of the report and its pictures.
  std::vector<int> thresholds{20, 40, 60};   ///< Gray thresholds of the report's rows.
};

struct BenchOptions {
  static constexpr unsigned kMostThreads = 64;  ///< As many as `scan.threads` takes.

  PipelineOptions pipeline{.pipeline = "maggic_3v3"};
  std::uint64_t frames = 300;
  std::optional<unsigned> threads;  ///< Left out: one per core, as far as may be.
  std::optional<std::filesystem::path> json;
};

struct SweepOptions {
  PipelineOptions pipeline;
  std::string images;                      ///< Folder or pattern.
  std::filesystem::path output = "sweep";  ///< Folder of plots and tables.
  std::vector<std::string> normalizers;    ///< None: every colour normalizer there is.
  double share_percent = 90.0;
};

struct PlotNormalizerOptions {
  std::string normalizer;
  std::optional<std::filesystem::path> output;  ///< SVG; left out: `<normalizer>.svg`.
};

struct CalibrateOptions {
  PipelineOptions pipeline;
  std::filesystem::path output;
  std::uint64_t frames = 100;
  std::vector<std::string> corners;  ///< None or four of `x,y`.
  std::optional<int> gray_threshold;
};

struct ImportOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;
  std::optional<std::string> image_size;  ///< `WxH` of the picture field corners were taken in.
};

struct PluginsOptions {};

struct DescribeOptions {
  std::vector<std::string> names;  ///< Plugins or pipeline sections; empty: everything.
};

struct NewOptions {
  std::string kind;
  std::string name;
  std::filesystem::path folder;
};

using Command =
    std::variant<RunOptionsGiven, StudioOptions, ScoreOptions, CompareOptions, BenchOptions,
                 SweepOptions, PlotNormalizerOptions, CalibrateOptions, ImportOptions, CheckOptions,
                 PluginsOptions, DescribeOptions, NewOptions>;

struct CommandLine {
  std::vector<std::filesystem::path> plugin_folders;  ///< Searched after the usual ones.
  Command command;
};

ExitCode run_command(const RunOptionsGiven& options, const CommandLine& line);
ExitCode studio_command(const StudioOptions& options, const CommandLine& line);
ExitCode score_command(const ScoreOptions& options, const CommandLine& line);
ExitCode compare_command(const CompareOptions& options, const CommandLine& line);
ExitCode bench_command(const BenchOptions& options, const CommandLine& line);
ExitCode sweep_command(const SweepOptions& options, const CommandLine& line);
ExitCode plot_normalizer_command(const PlotNormalizerOptions& options, const CommandLine& line);
ExitCode calibrate_command(const CalibrateOptions& options, const CommandLine& line);
ExitCode import_command(const ImportOptions& options, const CommandLine& line);
ExitCode check_command(const CheckOptions& options, const CommandLine& line);
ExitCode plugins_command(const PluginsOptions& options, const CommandLine& line);
ExitCode describe_command(const DescribeOptions& options, const CommandLine& line);
ExitCode new_command(const NewOptions& options, const CommandLine& line);

}  // namespace maggic::app
