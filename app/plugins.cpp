/// `maggic plugins`: what was found, and what was refused and why.

#include <cstdio>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/pipeline_options.hpp"
#include "app/text_table.hpp"

namespace maggic::app {

ExitCode plugins_command(const PluginsOptions& /*options*/, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  const PluginRegistry::Scan scan = registry.scan();
  using Align = TextTable::Align;
  const auto width = static_cast<std::size_t>(Console(stdout).width());

  TextTable found({Align::kLeft, Align::kLeft, Align::kLeft, Align::kLeft});
  found.add({"KIND", "NAME", "WHAT IT DOES", "FILE"});
  for (const PluginInfo& plugin : scan.plugins) {
    found.add(
        {std::string(name_of(plugin.kind)), plugin.name, plugin.summary, plugin.file.string()});
  }
  fmt::print("{}", found.to_string(0, width));

  if (!scan.refused.empty()) {
    TextTable refused({Align::kLeft, Align::kLeft});
    for (const PluginRefusal& refusal : scan.refused) {
      refused.add({refusal.file.string(), refusal.reason});
    }
    fmt::print("\nrefused\n{}", refused.to_string(2, width));
  }
  return kFine;
}

}  // namespace maggic::app
