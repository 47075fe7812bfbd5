/// `maggic import`: other programs' calibrations as one of ours.

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/field.hpp"
#include "maggic/foreign_calibration.hpp"
#include "maggic/parameter_reader.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

bool read_side(std::string_view text, int& side) {
  constexpr int kLongest = 65'535;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, side);
  return error == std::errc() && stop == end && side >= 1 && side <= kLongest;
}

cv::Size size_from(std::string_view text) {
  const std::size_t middle = text.find('x');
  cv::Size size;
  if (middle == std::string_view::npos || !read_side(text.substr(0, middle), size.width) ||
      !read_side(text.substr(middle + 1), size.height)) {
    throw std::invalid_argument(fmt::format(
        "--image-size: found '{}', expected WIDTHxHEIGHT in pixels, such as 640x480", text));
  }
  return size;
}

std::vector<ForeignCalibration> read_files(const std::vector<fs::path>& files) {
  std::vector<ForeignCalibration> calibrations;
  std::vector<Mistake> mistakes;
  for (const fs::path& file : files) {
    try {
      calibrations.push_back(load_foreign_calibration(file));
    } catch (const ConfigError& error) {
      mistakes.insert(mistakes.end(), error.mistakes().begin(), error.mistakes().end());
    }
  }
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  return calibrations;
}

/// Reads what is to be written as a run would, so that a file that cannot be used is never made.
void check(const ImportedCalibration& imported, const std::string& file, PluginRegistry& registry,
           Reporter& reporter) {
  const Palette palette = Palette::standard();
  const Node document = parse_document(imported.yaml, file);
  if (const Node* segmenters = document.find("segmenter")) {
    for (const Node::Entry& entry : segmenters->entries) {
      const auto stage = registry.create<Segmenter>(entry.key);
      configure_stage(*stage, to_yaml(entry.value), palette, reporter);
    }
  }
  if (const Node* section = document.find("field")) {
    FieldParameters field;
    std::vector<Mistake> mistakes;
    read_parameters(
        *section, palette, [&](Parameters& p) { field.describe(p); }, mistakes);
    if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  }
}

void refuse_overwriting(const ImportOptions& options) {
  for (const fs::path& file : options.files) {
    std::error_code failed;
    const bool same = fs::equivalent(file, options.output, failed) && !failed;
    if (!same) continue;
    throw std::invalid_argument(
        fmt::format("-o: writing '{}' would destroy what is imported", options.output.string()));
  }
}

}  // namespace

ExitCode import_command(const ImportOptions& options, const CommandLine& line) {
  std::optional<cv::Size> image_size_px;
  if (options.image_size) image_size_px = size_from(*options.image_size);
  refuse_overwriting(options);
  const std::vector<ForeignCalibration> calibrations = read_files(options.files);
  const bool has_corners = std::ranges::any_of(calibrations, [](const ForeignCalibration& one) {
    return std::holds_alternative<FieldLimits>(one);
  });
  if (image_size_px && !has_corners) {
    throw std::invalid_argument(
        "--image-size: none of the files has corners, expected it with a fieldLimits.json only");
  }
  const ImportedCalibration imported = import_calibrations(calibrations, image_size_px);

  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  check(imported, options.output.string(), registry, reporter);
  try {
    write_file_atomically(options.output, imported.yaml);
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  for (const std::string& note : imported.notes) {
    console.line(note, Console::Tone::kWarning, "note: ");
  }
  fmt::print("wrote {}: {}\n", options.output.string(), fmt::join(imported.found, ", "));
  return kFine;
}

}  // namespace maggic::app
