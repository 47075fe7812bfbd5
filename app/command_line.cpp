#include "app/command_line.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

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

/// CLI11's own range check prints the largest double in full. This one also rewrites the number in
/// plain decimals, because CLI11 would read 010 as octal.
template <class Number>
CLI::Validator above_zero(std::string_view expected) {
  return CLI::Validator(
      [expected](std::string& text) -> std::string {
        Number number{};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, number);
        const bool is_usable = error == std::errc() && stop == end && number > Number{0} &&
                               number <= std::numeric_limits<Number>::max();
        if (!is_usable) return fmt::format("found '{}', expected {}", text, expected);
        text = fmt::format("{}", number);
        return {};
      },
      "ABOVE 0");
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

/// ", did you mean 'word'?", or nothing where no known word is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;
  if (known.empty() || word.size() > kLongest) return {};
  const auto distance = [word](const std::string& other) { return edit_distance(word, other); };
  const std::string& nearest = *std::ranges::min_element(known, {}, distance);
  // Two neighbours swapped, the commonest slip, are two edits; more make a short word another.
  const std::size_t most = std::max<std::size_t>(2, word.size() / 3);
  if (distance(nearest) > most || distance(nearest) >= word.size()) return {};
  return fmt::format(", did you mean '{}'?", nearest);
}

/// CLI11 calls a mistyped command or option "not expected"; say what would have been.
std::string unknown_word_text(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) return {};
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (left.front().starts_with('-')) {
    const std::string name = left.front().substr(0, left.front().find('='));
    std::vector<std::string> known;
    const auto add_options_of = [&known](const CLI::App& owner) {
      for (const CLI::Option* option : owner.get_options()) {
        for (const std::string& word : option->get_lnames()) known.push_back("--" + word);
      }
    };
    add_options_of(app);
    for (const CLI::App* command : commands) add_options_of(*command);
    return fmt::format("unknown option '{}'{}\n", name, suggestion(name, known));
  }
  if (!commands.empty()) return {};
  const std::vector<std::string> known(kCommands.begin(), kCommands.end());
  return fmt::format("unknown command '{}'{} (known: {})\n", left.front(),
                     suggestion(left.front(), known), fmt::join(known, ", "));
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
      ->transform(above_zero<std::uint64_t>("a whole number above 0"));
  run_app
      ->add_option("--duration", run.duration_s, "End after so many seconds of the source's time")
      ->transform(above_zero<double>("a number of seconds above 0"));
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
    std::string text = unknown_word_text(app);
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
