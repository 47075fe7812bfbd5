/// `maggic check`: finds mistakes in pipeline files and, given a source, colours that lie badly.

#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/border_notes.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"

namespace maggic::app {

ExitCode check_command(const CheckOptions& options, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  std::size_t mistakes = 0;
  for (const std::string& pipeline : options.pipelines) {
    PipelineOptions one = options.common;
    one.pipeline = pipeline;
    try {
      BuiltPipeline built = build_pipeline(make_request(one), registry, reporter);
      for (const Mistake& note : built.notes) {
        console.line(note.to_string(), Console::Tone::kWarning, "note: ");
      }
      if (options.common.source) look_at_source(built, console);
      fmt::print("{}: ok\n", pipeline);
    } catch (const ConfigError& error) {
      mistakes += error.mistakes().size();
      console.line(error.what());
    } catch (const std::exception& error) {
      ++mistakes;
      console.line(fmt::format("{}: {}", pipeline, error.what()));
    }
  }
  if (mistakes == 0) return kFine;
  console.line(fmt::format("{} mistake{}", mistakes, mistakes == 1 ? "" : "s"));
  return kMistake;
}

}  // namespace maggic::app
