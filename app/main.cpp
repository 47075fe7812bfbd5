/// The program `maggic`. See commands.hpp for what it can be asked to do.

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "maggic/config_error.hpp"

namespace {

using namespace maggic::app;

struct Dispatch {
  const CommandLine& line;
  ExitCode operator()(const RunOptionsGiven& o) const { return run_command(o, line); }
  ExitCode operator()(const StudioOptions& o) const { return studio_command(o, line); }
  ExitCode operator()(const ScoreOptions& o) const { return score_command(o, line); }
  ExitCode operator()(const CompareOptions& o) const { return compare_command(o, line); }
  ExitCode operator()(const BenchOptions& o) const { return bench_command(o, line); }
  ExitCode operator()(const SweepOptions& o) const { return sweep_command(o, line); }
  ExitCode operator()(const PlotNormalizerOptions& o) const {
    return plot_normalizer_command(o, line);
  }
  ExitCode operator()(const CalibrateOptions& o) const { return calibrate_command(o, line); }
  ExitCode operator()(const ImportOptions& o) const { return import_command(o, line); }
  ExitCode operator()(const CheckOptions& o) const { return check_command(o, line); }
  ExitCode operator()(const PluginsOptions& o) const { return plugins_command(o, line); }
  ExitCode operator()(const DescribeOptions& o) const { return describe_command(o, line); }
  ExitCode operator()(const NewOptions& o) const { return new_command(o, line); }
};

/// The registry passes over a missing folder, which is right for the usual places only.
void check_plugin_folders(const CommandLine& line) {
  for (const std::filesystem::path& folder : line.plugin_folders) {
    std::error_code ignored;
    if (std::filesystem::is_directory(folder, ignored)) continue;
    throw std::invalid_argument(
        fmt::format("--plugin-path: found '{}', expected a folder that exists", folder.string()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that goes away is a write error for the sink to report, not a reason to die.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const auto parsed = parse_command_line(std::span<const char* const>(argv, argc).subspan(1));
    if (const auto* end = std::get_if<EarlyEnd>(&parsed)) {
      fmt::print(end->code == kFine ? stdout : stderr, "{}", end->text);
      return end->code;
    }
    const CommandLine& line = std::get<CommandLine>(parsed);
    check_plugin_folders(line);
    return std::visit(Dispatch{line}, line.command);
  } catch (const maggic::ConfigError& error) {
    const std::size_t count = error.mistakes().size();
    fmt::print(stderr, "{}\n{} mistake{}; nothing was run\n", error.what(), count,
               count == 1 ? "" : "s");
  } catch (const std::exception& error) {
    fmt::print(stderr, "maggic: {}\n", error.what());
  }
  return kMistake;
}
