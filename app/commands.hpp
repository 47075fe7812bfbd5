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

struct RunOptionsGiven {
  PipelineOptions pipeline;
  std::optional<std::uint64_t> frames;
  std::optional<double> duration_s;   ///< Of capture time, so a recording may take less.
  std::optional<std::string> output;  ///< JSON Lines; `-` is standard output.
  std::optional<std::string> video;
  bool realtime = false;
};

struct CheckOptions {
  std::vector<std::string> pipelines;
  PipelineOptions common;  ///< Its `pipeline` is not used.
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
    std::variant<RunOptionsGiven, CheckOptions, PluginsOptions, DescribeOptions, NewOptions>;

struct CommandLine {
  std::vector<std::filesystem::path> plugin_folders;  ///< Searched after the usual ones.
  Command command;
};

ExitCode run_command(const RunOptionsGiven& options, const CommandLine& line);
ExitCode check_command(const CheckOptions& options, const CommandLine& line);
ExitCode plugins_command(const PluginsOptions& options, const CommandLine& line);
ExitCode describe_command(const DescribeOptions& options, const CommandLine& line);
ExitCode new_command(const NewOptions& options, const CommandLine& line);

}  // namespace maggic::app
