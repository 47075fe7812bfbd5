/// `maggic score`: run a pipeline and compare what it finds with the truth.

#include <atomic>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/border_notes.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "app/progress.hpp"
#include "app/score_json.hpp"
#include "app/score_report.hpp"
#include "app/stop_signals.hpp"
#include "app/truth_option.hpp"
#include "app/why.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/runner.hpp"
#include "maggic/score_figures.hpp"

namespace maggic::app {
namespace {

/// Everything that is known once the run is over.
struct Score {
  Scorecard card;
  RunSummary summary;
  std::optional<double> corners_px;

  std::vector<Figure> figures() const { return score_figures(card, summary.times, corners_px); }
};

std::invalid_argument no_truth(const std::string& source) {
  return std::invalid_argument(fmt::format(
      "the source '{}' does not know what is really in its frames: expected --truth FILE, or a "
      "source with its own truth such as synthetic",
      source));
}

/// @throws std::exception at the first frame that shows that the truth does not belong to it.
Score run_and_judge(BuiltPipeline& built, const ScoreOptions& options, const std::string& source,
                    TruthOption& truth, Console& console, ConsoleReporter& reporter, Why& why) {
  Score score{Scorecard(truth.tolerance()), {}, {}};
  BlobColors blob_colors;
  RunOptions run_options;
  run_options.max_frames = options.frames;
  std::atomic<bool>& stop = stop_on_signals();
  {
    Progress progress(console, options.frames);
    score.summary = run(built, run_options, stop, reporter,
                        [&](const FrameResult& result, const RunSummary& so_far) {
                          progress.update(result, so_far, so_far.source.frame_count);
                          blob_colors.offer(result, built.pipeline->channel_gains());
                          why.look(*built.pipeline, result, stop);
                          const TrueScene* scene = truth.scene_in(result.frame);
                          if (scene == nullptr && !options.truth) throw no_truth(source);
                          if (scene == nullptr) return;
                          score.card.add(result.detections, *scene, *built.pipeline->field());
                        });
  }
  print_border_notes(*built.pipeline, blob_colors, console);
  if (truth.file() && built.pipeline->field()) {
    score.corners_px = corner_error_px(*built.pipeline->field(), *truth.file());
  }
  return score;
}

/// @throws std::invalid_argument when frames came, but none of them could be judged.
void expect_something_judged(const Score& score, const ScoreOptions& options) {
  if (score.card.frames() > 0 || score.summary.processed == 0) return;
  throw std::invalid_argument(
      fmt::format("--truth: none of the {} frames is in {}: expected the numbers of frames "
                  "counted from 0",
                  score.summary.processed, options.truth->string()));
}

void write_json(const ScoreOptions& options, const PipelineRequest& request,
                const std::optional<std::string>& source, const Score& score,
                const Palette& palette) {
  const auto text_or_null = [](const auto& value) {
    return value ? OrderedJson(*value) : OrderedJson();
  };
  const OrderedJson json = {
      {"schema", "maggic-score-1"},
      {"pipeline", request.pipeline.string()},
      {"calibration", request.calibration ? OrderedJson(request.calibration->string()) : nullptr},
      {"source", text_or_null(source)},
      {"truth", options.truth ? OrderedJson(options.truth->string()) : nullptr},
      {"tolerance", to_json(score.card.tolerance())},
      {"frames", frames_json(score.card, score.summary)},
      {"figures", to_json(score.figures())},
      {"objects", objects_json(score.card, palette)}};
  write_file_atomically(*options.json, json_text(json));
}

ExitCode report(const Score& score, const std::vector<Requirement>& requirements,
                const ScoreOptions& options, const Palette& palette, Console& console) {
  const std::vector<Figure> figures = score.figures();
  fmt::print("{} frame{} judged against {}, tolerance {}\n\n{}\n{}", score.card.frames(),
             score.card.frames() == 1 ? "" : "s",
             options.truth ? options.truth->string() : "the source's own truth",
             tolerance_text(score.card.tolerance()), objects_text(score.card, palette),
             rest_text(figures));
  std::fflush(stdout);
  ExitCode code = kFine;
  for (const std::string& sentence : unmet(requirements, figures)) {
    console.line(sentence, Console::Tone::kError, "not met: ");
    code = kFailed;
  }
  return code;
}

}  // namespace

ExitCode score_command(const ScoreOptions& options, const CommandLine& line) {
  Why why(options.why);
  std::vector<Requirement> requirements;
  if (options.require) requirements = parse_requirements(*options.require);
  const PipelineRequest request = make_request(options.pipeline);
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  BuiltPipeline built = build_pipeline(request, registry, reporter);
  for (const Mistake& note : built.notes) {
    console.line(note.to_string(), Console::Tone::kWarning, "note: ");
  }
  // A score measures; it does not write over the log of the last match.
  built.sinks.clear();

  std::vector<Mistake> known_notes;
  const std::optional<std::string> source = source_path(merged_document(request, known_notes));
  const Palette& palette = built.pipeline->palette();
  TruthOption truth(options.truth, palette);
  if (const std::string doubt = truth.doubt_about(source); !doubt.empty()) {
    console.line(doubt, Console::Tone::kWarning, "warning: ");
  }
  if (options.json) {
    std::vector<std::filesystem::path> inputs{request.pipeline};
    if (request.calibration) inputs.push_back(*request.calibration);
    if (options.truth) inputs.push_back(*options.truth);
    if (source) inputs.emplace_back(*source);
    check_report(*options.json, "--json", inputs);
  }

  const Score score = run_and_judge(built, options, source.value_or(built.source.name), truth,
                                    console, reporter, why);
  reporter.print_totals();
  expect_something_judged(score, options);
  if (score.summary.processed == 0) {
    const std::string& error = score.summary.first_error;
    console.line(error.empty() ? "no frame ever came from the source" : error,
                 Console::Tone::kError, "error: ");
    return kFailed;
  }
  const ExitCode code = report(score, requirements, options, palette, console);
  try {
    if (options.json) write_json(options, request, source, score, palette);
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  if (!score.summary.clean()) {
    console.line("something failed during the run: " + score.summary.first_error,
                 Console::Tone::kError, "error: ");
    return kFailed;
  }
  const ExitCode asked = why.print(stdout, console);
  return code == kFine ? asked : code;
}

}  // namespace maggic::app
