#include "app/command_line.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/command_options.hpp"

namespace maggic::app {
namespace {

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
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
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

  std::vector<OfferedCommand> offered = offer_commands(app);

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

  for (OfferedCommand& command : offered) {
    if (command.app->parsed()) line.command = command.chosen();
  }
  return line;
}

}  // namespace maggic::app
