#include "app/command_line.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace maggic::app {
namespace {

constexpr std::array<std::string_view, 5> kCommands{"run", "check", "plugins", "describe", "new"};

void add_pipeline_options(CLI::App& command, PipelineOptions& options) {
  command.add_option("--source", options.source,
                     "Camera number, file, folder, glob, URL or 'synthetic' in place of the "
                     "pipeline's source");
  command.add_option("--calibration", options.calibration,
                     "Venue numbers laid over the pipeline (YAML file)");
  command
      .add_option("--set", options.assignments,
                  "Change one value: path.to.key=value; may be given several times")
      ->allow_extra_args(false);
}

/// CLI11 calls a mistyped command "not expected"; say what would have been.
std::string wrong_command_text(std::span<const char* const> arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    if (word == "--plugin-path") {
      ++i;
    } else if (!word.starts_with('-')) {
      if (std::ranges::find(kCommands, word) != kCommands.end()) return {};
      return fmt::format("unknown command '{}' (known: {})\n", word, fmt::join(kCommands, ", "));
    }
  }
  return {};
}

}  // namespace

std::variant<CommandLine, EarlyEnd> parse_command_line(std::span<const char* const> arguments) {
  CLI::App app("Maggic finds robots and ball in the pictures of a robot-soccer field.", "maggic");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit codes: 0 fine, 1 something failed during the run, 2 wrong usage or "
      "configuration.\n'maggic COMMAND --help' tells more.");

  CommandLine line;
  app.add_option("--plugin-path", line.plugin_folders,
                 "Folder with further plugins; may be given several times")
      ->allow_extra_args(false);

  RunOptionsGiven run;
  CLI::App* run_app = app.add_subcommand("run", "Run a pipeline on its source");
  run_app->add_option("pipeline", run.pipeline.pipeline, "Pipeline file or name")->required();
  add_pipeline_options(*run_app, run.pipeline);
  run_app->add_option("--frames", run.frames, "End after so many frames")
      ->check(CLI::PositiveNumber);
  run_app
      ->add_option("--duration", run.duration_s, "End after so many seconds of the source's time")
      ->check(CLI::PositiveNumber);
  run_app->add_option("--output", run.output, "Write JSON Lines here ('-': standard output)");
  run_app->add_option("--video", run.video, "Write an annotated video here (.mp4)");
  run_app->add_flag("--realtime", run.realtime, "Play a recording at its own pace, as if live");

  CheckOptions check;
  CLI::App* check_app =
      app.add_subcommand("check", "Find every mistake in pipeline files without running them");
  check_app->add_option("pipelines", check.pipelines, "Pipeline files or names")->required();
  add_pipeline_options(*check_app, check.common);

  CLI::App* plugins_app =
      app.add_subcommand("plugins", "List the plugins found, and files refused with the reason");

  DescribeOptions describe;
  CLI::App* describe_app = app.add_subcommand(
      "describe", "Show the parameters of plugins and pipeline sections (field, blobs)");
  describe_app->add_option("names", describe.names, "Plugin or section names; none: everything");

  NewOptions created;
  CLI::App* new_app =
      app.add_subcommand("new", "Write the folder of a new, working plugin with its test");
  new_app->add_option("kind", created.kind, "source, normalizer, segmenter, tracker or sink")
      ->required();
  new_app->add_option("name", created.name, "Name of the plugin")->required();
  new_app->add_option("folder", created.folder, "Folder to write it into")->required();

  // CLI11 wants them as from a stack: last argument first.
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::Success& asked_for) {
    std::ostringstream out;
    std::ostringstream none;
    app.exit(asked_for, out, none);
    return EarlyEnd{kFine, out.str()};
  } catch (const CLI::ParseError& error) {
    std::string text = wrong_command_text(arguments);
    if (text.empty()) text = fmt::format("{}\n", error.what());
    return EarlyEnd{kMistake, fmt::format("{}Run 'maggic --help' for how it is used.\n", text)};
  }

  if (run_app->parsed()) line.command = std::move(run);
  if (check_app->parsed()) line.command = std::move(check);
  if (plugins_app->parsed()) line.command = PluginsOptions{};
  if (describe_app->parsed()) line.command = std::move(describe);
  if (new_app->parsed()) line.command = std::move(created);
  return line;
}

}  // namespace maggic::app
