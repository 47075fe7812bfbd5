/// `maggic plot normalizer`: a normalizer as a vector field.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/normalizer_plot.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/svg_plot.hpp"

namespace maggic::app {
namespace {

/// With the parameters it has by default. What the plugin throws ends with it; see describe.cpp.
std::string drawn(Stage& stage, const std::string& name, const Palette& palette,
                  Reporter& reporter) {
  std::string reason;
  try {
    configure_stage(stage, "", palette, reporter);
    const auto* by_color = dynamic_cast<const ColorNormalizer*>(&stage);
    if (by_color != nullptr) return to_svg(normalizer_plot(name, *by_color));
    reason = "it needs whole pictures; expected one that judges single colours";
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "an exception that is not a std::exception";
  }
  throw std::invalid_argument(fmt::format("cannot draw normalizer '{}': {}", name, reason));
}

}  // namespace

ExitCode plot_normalizer_command(const PlotNormalizerOptions& options, const CommandLine& line) {
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  const Palette palette = Palette::standard();
  const StagePtr<Normalizer> stage = registry.create<Normalizer>(options.normalizer);
  const std::string svg = drawn(*stage, options.normalizer, palette, reporter);
  const std::filesystem::path file = options.output.value_or(options.normalizer + ".svg");
  try {
    write_file_atomically(file, svg);
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  fmt::print("{}\n", file.string());
  return kFine;
}

}  // namespace maggic::app
