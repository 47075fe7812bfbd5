/// `maggic calibrate`: find a venue's numbers from a few frames and write them down.

#include <array>
#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/frame_sampler.hpp"
#include "app/pipeline_options.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/calibration.hpp"
#include "maggic/field.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

double number_from(std::string_view text, std::string_view whole) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  throw std::invalid_argument(fmt::format(
      "--corners: found '{}', expected two numbers with a comma, such as 39,-5", whole));
}

cv::Point2d corner_from(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) number_from("", text);  // says what is expected
  return {number_from(text.substr(0, comma), text), number_from(text.substr(comma + 1), text)};
}

/// Says what is wrong with corners where they were given, before anything runs.
void check_corners(const std::array<cv::Point2d, 4>& corners_px) {
  FieldParameters field;
  field.corners_px.assign(corners_px.begin(), corners_px.end());
  try {
    Field(field, {1, 1});
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("--corners: {}", error.what()));
  }
}

/// A calibration may be replaced by a better one, nothing else that is in use may.
void check_output(const CalibrateOptions& options, const PipelineRequest& request,
                  const Node& document) {
  const fs::path& output = options.output;
  std::error_code ignored;
  const auto refuse_if_same = [&](const fs::path& other, std::string_view what) {
    if (!fs::equivalent(output, other, ignored)) return;
    throw std::invalid_argument(
        fmt::format("writing '{}' would destroy {}; name another file", output.string(), what));
  };
  refuse_if_same(request.pipeline, "the pipeline itself");
  if (const auto read = source_path(document)) refuse_if_same(*read, "what is looked at");
  if (fs::is_directory(output, ignored)) {
    throw std::invalid_argument(
        fmt::format("'{}' is a folder, expected the name of a file to "
                    "write",
                    output.string()));
  }
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw std::invalid_argument(fmt::format("there is no folder '{}' to write '{}' into",
                                            folder.string(), output.filename().string()));
  }
}

/// The pipeline's own corners are of its own source; those of a calibration or of --set are meant.
bool is_field_known(const PipelineOptions& options, const Node& document,
                    const PipelineRequest& request) {
  const Node* field = document.find("field");
  const Node* corners = field != nullptr ? field->find("corners_px") : nullptr;
  if (corners == nullptr) return false;
  return !options.source || corners->place.file != request.pipeline.string();
}

std::string text_of(const PatternScore& score) {
  return fmt::format(
      "{:.2f} complete robots a frame, {:.2f} doubtful, a ball in {:.0f} % of frames", score.robots,
      score.doubtful, 100.0 * score.balls);
}

void report(const CalibrationResult& result, Console& console) {
  for (const std::string& finding : result.findings) fmt::print("  {}\n", finding);
  fmt::print("  before: {}\n", text_of(result.before));
  if (!result.yaml.empty()) fmt::print("  now:    {}\n", text_of(result.after));
  std::fflush(stdout);
  for (const std::string& sentence : result.unsettled) {
    console.line(sentence, Console::Tone::kWarning, "unsettled: ");
  }
}

}  // namespace

ExitCode calibrate_command(const CalibrateOptions& options, const CommandLine& line) {
  const PipelineRequest request = make_request(options.pipeline);
  CalibrationRequest calibration;
  std::vector<Mistake> notes;
  calibration.with_known = merged_document(request, notes);
  check_output(options, request, *calibration.with_known);
  if (!options.corners.empty()) {
    calibration.corners_px.emplace();
    for (std::size_t i = 0; i < 4; ++i) {
      (*calibration.corners_px)[i] = corner_from(options.corners[i]);
    }
    check_corners(*calibration.corners_px);
  }
  calibration.gray_threshold = options.gray_threshold;

  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  calibration.field_is_known = is_field_known(options.pipeline, *calibration.with_known, request);
  PipelineRequest plain = request;
  plain.calibration.reset();
  std::vector<Mistake> ignored;
  calibration.document = merged_document(plain, ignored);
  BuiltPipeline built = build_pipeline(request, registry, reporter);
  for (const Mistake& note : notes) {
    console.line(note.to_string(), Console::Tone::kWarning, "note: ");
  }

  std::vector<cv::Mat> frames;
  CalibrationResult result;
  try {
    if (console.is_terminal()) console.live("looking at frames …");
    frames = sample_frames(*built.source.stage, options.frames, console);
    if (frames.empty()) {
      console.line("no frame ever came from the source", Console::Tone::kError, "error: ");
      return kFailed;
    }
    if (console.is_terminal()) console.live("learning colours, field and light …");
    result = calibrate(calibration, frames, registry);
    console.end_live();
  } catch (const ConfigError&) {
    throw;
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  report(result, console);
  if (result.yaml.empty()) {
    console.line("nothing was written", Console::Tone::kError, "error: ");
    return kFailed;
  }
  constexpr double kWorse = 0.02;
  if (result.after.value() < result.before.value() - kWorse) {
    console.line(fmt::format("what was found does worse than the numbers there are, so '{}' was "
                             "not written",
                             options.output.string()),
                 Console::Tone::kError, "error: ");
    return kFailed;
  }
  write_file_atomically(options.output, result.yaml);
  fmt::print("{} written; use it with --calibration {}\n", options.output.string(),
             options.output.string());
  return kFine;
}

}  // namespace maggic::app
