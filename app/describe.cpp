/// `maggic describe`: the parameters of plugins and pipeline sections.

#include <cstdio>
#include <string>
#include <string_view>

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

void print_parameters(const Describe& describe) {
  const Palette palette = Palette::standard();
  const std::vector<ParameterRow> rows = parameter_table(palette, describe);
  if (rows.empty()) {
    fmt::print("  no parameters\n");
    return;
  }
  using Align = TextTable::Align;
  TextTable table(std::vector<Align>(6, Align::kLeft));
  table.add({"PARAMETER", "TYPE", "DEFAULT", "RANGE", "UNIT", "MEANING"});
  for (const ParameterRow& row : rows) {
    table.add({row.path, row.type, row.default_value, row.range, row.unit, row.meaning});
  }
  const auto width = static_cast<std::size_t>(Console(stdout).width());
  fmt::print("{}", table.to_string(2, width));
}

bool print_section(std::string_view name) {
  if (name == "field") {
    fmt::print("section field: the field and the camera above it\n");
    print_parameters([](Parameters& p) { FieldParameters().describe(p); });
  } else if (name == "blobs") {
    fmt::print("section blobs: which coloured regions are looked at\n");
    print_parameters([](Parameters& p) { BlobParameters().describe(p); });
  } else {
    return false;
  }
  return true;
}

void print_plugin(PluginRegistry& registry, std::string_view name) {
  const PluginInfo info = registry.info(name);
  fmt::print("{} {}: {}\n", name_of(info.kind), info.name, info.summary);
  const StagePtr<Stage> stage = registry.create(info.kind, name);
  print_parameters([&](Parameters& p) { stage->describe(p); });
}

}  // namespace

ExitCode describe_command(const DescribeOptions& options, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  std::vector<std::string> names = options.names;
  if (names.empty()) {
    names = {"field", "blobs"};
    for (const PluginInfo& plugin : registry.scan().plugins) names.push_back(plugin.name);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) fmt::print("\n");
    if (!print_section(names[i])) print_plugin(registry, names[i]);
  }
  return kFine;
}

}  // namespace maggic::app
