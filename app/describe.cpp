/// `maggic describe`: the parameters of plugins and pipeline sections.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/pipeline_options.hpp"
#include "app/text_table.hpp"
#include "maggic/field.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/pipeline.hpp"

namespace maggic::app {
namespace {

constexpr std::size_t kWidestTable = 110;   // longer lines are hard to follow, terminal or not
constexpr std::size_t kWidestDefault = 24;  // one list of polygons must not push the rest aside

void print_parameters(const std::vector<ParameterRow>& rows) {
  if (rows.empty()) {
    fmt::print("  no parameters\n");
    return;
  }
  using Align = TextTable::Align;
  TextTable table(std::vector<Align>(6, Align::kLeft));
  table.add({"PARAMETER", "TYPE", "DEFAULT", "RANGE", "UNIT", "MEANING"});
  for (const ParameterRow& row : rows) {
    table.add({row.path, row.type, shortened(row.default_value, kWidestDefault), row.range,
               row.unit, row.meaning});
  }
  const auto width = static_cast<std::size_t>(Console(stdout).width());
  fmt::print("{}", table.to_string(2, std::min(width, kWidestTable)));
}

/// What is printed of one plugin or section.
struct Description {
  std::string title;
  std::vector<ParameterRow> rows;
};

std::optional<Description> describe_section(std::string_view name) {
  const Palette palette = Palette::standard();
  if (name == "field") {
    return Description{
        "section field: the field and the camera above it",
        parameter_table(palette, [](Parameters& p) { FieldParameters().describe(p); })};
  }
  if (name == "blobs") {
    return Description{
        "section blobs: which coloured regions are looked at",
        parameter_table(palette, [](Parameters& p) { BlobParameters().describe(p); })};
  }
  if (name == "light") {
    return Description{
        "section light: following light that changes",
        parameter_table(palette, [](Parameters& p) { LightParameters().describe(p); })};
  }
  if (name == "scan") {
    return Description{
        "section scan: which pixels are looked at, and by how many threads",
        parameter_table(palette, [](Parameters& p) { ScanParameters().describe(p); })};
  }
  return std::nullopt;
}

/// @throws PluginError also for whatever the plugin throws: its own exception object is gone before
///   the stage is, and with the stage may go the library that holds its type.
std::vector<ParameterRow> rows_of(Stage& stage, const PluginInfo& info) {
  std::string reason;
  try {
    return parameter_table(Palette::standard(), [&](Parameters& p) { stage.describe(p); });
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "an exception that is not a std::exception";
  }
  throw PluginError(fmt::format("plugin '{}' ({}) cannot describe itself: {}", info.name,
                                info.file.string(), reason));
}

Description describe_plugin(PluginRegistry& registry, const PluginInfo& info) {
  const StagePtr<Stage> stage = registry.create(info.kind, info.name);
  return {fmt::format("{} {}: {}", name_of(info.kind), info.name, info.summary),
          rows_of(*stage, info)};
}

}  // namespace

ExitCode describe_command(const DescribeOptions& options, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  std::vector<std::string> names = options.names;
  if (names.empty()) {
    names = {"field", "blobs", "light", "scan"};
    for (const PluginInfo& plugin : registry.scan().plugins) names.push_back(plugin.name);
  }
  ExitCode code = kFine;
  bool first = true;
  for (const std::string& name : names) {
    std::optional<Description> description = describe_section(name);
    if (!description) {
      const PluginInfo info = registry.info(name);  // not there: the command line is wrong
      try {
        description = describe_plugin(registry, info);
      } catch (const PluginError& error) {
        Console(stderr).line(error.what(), Console::Tone::kError, "error: ");
        code = kFailed;
        continue;
      }
    }
    fmt::print("{}{}\n", first ? "" : "\n", description->title);
    print_parameters(description->rows);
    first = false;
  }
  return code;
}

}  // namespace maggic::app
