/// `maggic new`: the folder of a plugin to start from.

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/new_plugin.hpp"
#include "app/pipeline_options.hpp"
#include "maggic/stage.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

StageKind kind_named(std::string_view name) {
  for (const StageKind kind : {StageKind::kSource, StageKind::kNormalizer, StageKind::kSegmenter,
                               StageKind::kTracker, StageKind::kSink}) {
    if (name_of(kind) == name) return kind;
  }
  throw std::invalid_argument(fmt::format(
      "there is no kind '{}' (known: source, normalizer, segmenter, tracker, sink)", name));
}

/// Two plugins of one name could not be told apart in a pipeline.
void refuse_name_of_known_plugin(std::string_view name, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  for (const PluginInfo& plugin : registry.scan().plugins) {
    if (plugin.name == name) {
      throw std::invalid_argument(
          fmt::format("there is a plugin '{}' already, the {} in {}; choose another name", name,
                      name_of(plugin.kind), plugin.file.string()));
    }
  }
}

/// `text` as one word for a shell.
std::string shell_word(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return std::string(text);
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

void print_next_steps(const fs::path& plugin, std::string_view name) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(plugin)) {
    files.push_back(entry.path().filename().string());
  }
  std::ranges::sort(files);
  fmt::print("wrote {}: {}\n", plugin.string(), fmt::join(files, ", "));

  const std::string source = shell_word(plugin.string());
  const std::string build = shell_word((plugin / "build").string());
  const std::string built = shell_word((plugin / "build/lib/maggic/plugins").string());
  fmt::print(
      "build, test and look at it (where Maggic is installed in an unusual place, add\n"
      "-D CMAKE_PREFIX_PATH=PLACE to the first command):\n"
      "  cmake -S {} -B {}\n"
      "  cmake --build {}\n"
      "  ctest --test-dir {} --output-on-failure\n"
      "  maggic describe {} --plugin-path {}\n",
      source, build, build, build, name, built);
}

}  // namespace

ExitCode new_command(const NewOptions& options, const CommandLine& line) {
  const StageKind kind = kind_named(options.kind);
  refuse_name_of_known_plugin(options.name, line);
  new_plugin(kind, options.name, options.folder);
  print_next_steps(fs::path(options.folder) / options.name, options.name);
  return kFine;
}

}  // namespace maggic::app
