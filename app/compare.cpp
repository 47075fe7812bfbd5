/// `maggic compare`: several pipelines on the same frames, against the truth and each other.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/compare_report.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_options.hpp"
#include "app/progress.hpp"
#include "app/score_json.hpp"
#include "app/score_report.hpp"
#include "app/stop_signals.hpp"
#include "app/truth_option.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/atomic_folder.hpp"
#include "maggic/comparison_report.hpp"
#include "maggic/label_picture.hpp"
#include "maggic/overlay.hpp"
#include "maggic/picture_row.hpp"
#include "maggic/png.hpp"
#include "maggic/side_by_side.hpp"

namespace maggic::app {
namespace {

constexpr std::size_t kDifferentFrames = 3;
constexpr std::uint64_t kFramesApart = 30;
constexpr std::string_view kReportFile = "report.html";
constexpr std::string_view kPictureStart = "different_frame_";

/// One of the pipelines that are compared.
struct Contestant {
  std::string name;
  PipelineRequest request;
  Node document;
  BuiltPipeline built;
  TruthOption truth;
};

bool is_report_file(std::string_view name) {
  return name == kReportFile || (name.starts_with(kPictureStart) && name.ends_with(".png"));
}

std::optional<std::string> calibration_for(const CompareOptions& options, std::size_t pipeline) {
  const std::size_t count = options.calibrations.size();
  if (count == 0) return std::nullopt;
  return options.calibrations[count == 1 ? 0 : pipeline];
}

void check_counts(const CompareOptions& options) {
  const std::size_t pipelines = options.pipelines.size();
  if (pipelines < 2) {
    throw std::invalid_argument("compare: found one pipeline, expected two or more");
  }
  const std::size_t calibrations = options.calibrations.size();
  if (calibrations > 1 && calibrations != pipelines) {
    throw std::invalid_argument(
        fmt::format("--calibration: found {} for {} pipelines, expected none, one for all, or one "
                    "for each",
                    calibrations, pipelines));
  }
}

std::string name_for(const PipelineRequest& request, std::size_t index, bool own_calibration) {
  // The letter keeps one pipeline with two calibrations apart.
  std::string name =
      fmt::format("{} {}", static_cast<char>('A' + index % 26), request.pipeline.stem().string());
  if (own_calibration && request.calibration) {
    name += fmt::format(" ({})", request.calibration->stem().string());
  }
  return name;
}

std::vector<Contestant> build(const CompareOptions& options, PluginRegistry& registry,
                              Console& console, Reporter& reporter) {
  std::vector<Contestant> contestants;
  for (std::size_t i = 0; i < options.pipelines.size(); ++i) {
    PipelineOptions given = options.common;
    given.pipeline = options.pipelines[i];
    given.calibration = calibration_for(options, i);
    PipelineRequest request = make_request(given);
    BuiltPipeline built = build_pipeline(request, registry, reporter);
    built.sinks.clear();
    for (const Mistake& note : built.notes) {
      console.line(note.to_string(), Console::Tone::kWarning, "note: ");
    }
    std::vector<Mistake> known_notes;
    Node document = merged_document(request, known_notes);
    TruthOption truth(options.truth, built.pipeline->palette());
    std::string name = name_for(request, i, options.calibrations.size() > 1);
    contestants.push_back({std::move(name), std::move(request), std::move(document),
                           std::move(built), std::move(truth)});
  }
  return contestants;
}

/// Everything that is kept of the frames.
struct Outcome {
  Comparison comparison;
  DifferentFrames different{kDifferentFrames, kFramesApart};
  cv::Mat segmented;  ///< The most different frame, as it came.
  std::uint64_t segmented_sequence = 0;
  std::vector<RunSummary> summaries;
};

cv::Mat drawn(const std::vector<Contestant>& contestants,
              std::span<const FrameResult* const> results) {
  std::vector<cv::Mat> pictures;
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Pipeline& pipeline = *contestants[i].built.pipeline;
    titles.push_back(contestants[i].name);
    cv::Mat& picture = pictures.emplace_back();
    if (results[i] == nullptr) continue;
    OverlayOptions overlay_options;
    overlay_options.scale = 1;
    Overlay(pipeline.palette(), overlay_options).draw(*results[i], *pipeline.field(), picture);
  }
  return picture_row(pictures, titles);
}

Outcome run_all(std::vector<Contestant>& contestants, const CompareOptions& options,
                Console& console, ConsoleReporter& reporter) {
  Outcome outcome{Comparison(contestants.size(), contestants.front().truth.tolerance())};
  std::vector<Pipeline*> pipelines;
  for (Contestant& contestant : contestants) pipelines.push_back(contestant.built.pipeline.get());

  Progress progress(console, options.frames);
  double widest = -1.0;
  outcome.summaries = run_side_by_side(
      contestants.front().built.source, pipelines, options.frames, stop_on_signals(), reporter,
      [&](std::span<const FrameResult* const> results, std::span<const RunSummary> so_far) {
        std::vector<Comparison::Entry> entries(results.size());
        const FrameResult* any = nullptr;
        for (std::size_t i = 0; i < results.size(); ++i) {
          if (results[i] == nullptr) continue;
          any = results[i];
          entries[i] = {results[i], pipelines[i]->field().get(),
                        contestants[i].truth.scene_in(results[i]->frame)};
        }
        if (any == nullptr) return;
        progress.update(*any, so_far.front(), so_far.front().source.frame_count);
        const double difference = outcome.comparison.add(entries);
        outcome.different.offer(any->frame.sequence, difference, [&] {
          if (difference > widest) {
            widest = difference;
            outcome.segmented = any->frame.bgr.clone();
            outcome.segmented_sequence = any->frame.sequence;
          }
          return drawn(contestants, results);
        });
      });
  return outcome;
}

std::vector<ComparedPipeline> compared(const std::vector<Contestant>& contestants,
                                       const Outcome& outcome) {
  std::vector<ComparedPipeline> pipelines;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Contestant& contestant = contestants[i];
    const auto& field = contestant.built.pipeline->field();
    std::optional<double> corners_px;
    if (field && contestant.truth.file()) {
      corners_px = corner_error_px(*field, *contestant.truth.file());
    }
    ComparedPipeline& pipeline = pipelines.emplace_back();
    pipeline.name = contestant.name;
    pipeline.figures =
        score_figures(outcome.comparison.against_truth(i), outcome.summaries[i].times, corners_px);
    if (i == 0) continue;
    pipeline.agreement =
        score_figures(outcome.comparison.against_first(i), StepStatistics(), std::nullopt);
  }
  return pipelines;
}

MethodLabels labels_of(const Contestant& contestant, const cv::Mat& bgr,
                       const std::vector<int>& thresholds, PluginRegistry& registry,
                       Reporter& reporter) {
  const Palette& palette = contestant.built.pipeline->palette();
  const PipelineParts& parts = contestant.built.pipeline->parts();
  const auto png_of = [&](Segmenter& segmenter) {
    const cv::Mat labels = label_picture(bgr, *parts.normalizer.stage, segmenter, palette.size());
    return png_bytes(colored_labels(labels, palette));
  };
  MethodLabels method{contestant.name, {}};
  const Node* section = contestant.document.find("segmenter");
  for (const int threshold : thresholds) {
    const auto segmenter =
        segmenter_with_threshold(*section, threshold, registry, {palette, reporter});
    if (!segmenter) break;
    method.pngs.push_back(png_of(*segmenter));
  }
  if (method.pngs.empty()) method.pngs.push_back(png_of(*parts.segmenter.stage));
  return method;
}

OrderedJson text_or_null(const std::optional<std::filesystem::path>& path) {
  return path ? OrderedJson(path->string()) : OrderedJson();
}

OrderedJson differences_json(const std::vector<Figure>& figures,
                             const std::vector<Figure>& of_first) {
  OrderedJson json = OrderedJson::object();
  std::vector<Figure> differences = figures;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const bool both = figures[i].value && of_first[i].value;
    differences[i].value =
        both ? std::optional(*figures[i].value - *of_first[i].value) : std::nullopt;
  }
  return to_json(differences);
}

OrderedJson comparison_json(const std::vector<Contestant>& contestants,
                            const std::vector<ComparedPipeline>& pipelines, const Outcome& outcome,
                            const CompareOptions& options,
                            const std::optional<std::string>& source) {
  OrderedJson json = {{"schema", "maggic-compare-1"},
                      {"source", source ? OrderedJson(*source) : OrderedJson()},
                      {"truth", text_or_null(options.truth)},
                      {"tolerance", to_json(outcome.comparison.against_truth(0).tolerance())},
                      {"pipelines", OrderedJson::array()},
                      {"different_frames", OrderedJson::array()}};
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const ComparedPipeline& pipeline = pipelines[i];
    json["pipelines"].push_back(
        {{"name", pipeline.name},
         {"pipeline", contestants[i].request.pipeline.string()},
         {"calibration", text_or_null(contestants[i].request.calibration)},
         {"frames", frames_json(outcome.comparison.against_truth(i), outcome.summaries[i])},
         {"figures", to_json(pipeline.figures)},
         {"differences",
          i == 0 ? OrderedJson() : differences_json(pipeline.figures, pipelines.front().figures)},
         {"agreement", i == 0 ? OrderedJson() : to_json(pipeline.agreement)}});
  }
  for (const DifferentFrames::Kept& kept : outcome.different.kept()) {
    json["different_frames"].push_back({{"frame", kept.sequence}, {"difference", kept.difference}});
  }
  return json;
}

std::vector<std::pair<std::string, std::string>> facts_of(
    const std::vector<Contestant>& contestants, const Outcome& outcome,
    const CompareOptions& options, const std::optional<std::string>& source, bool has_truth) {
  std::vector<std::pair<std::string, std::string>> facts;
  facts.emplace_back("source", source.value_or(contestants.front().built.source.name));
  facts.emplace_back("frames", std::to_string(outcome.summaries.front().taken()));
  facts.emplace_back("truth", options.truth ? options.truth->string()
                              : has_truth   ? "the source's own"
                                            : "not known");
  facts.emplace_back("tolerance", tolerance_text(outcome.comparison.against_truth(0).tolerance()));
  for (const Contestant& contestant : contestants) {
    std::string files = contestant.request.pipeline.string();
    if (contestant.request.calibration) {
      files += " with " + contestant.request.calibration->string();
    }
    facts.emplace_back(contestant.name, std::move(files));
  }
  for (const std::string& assignment : options.common.assignments) {
    facts.emplace_back("set", assignment);
  }
  return facts;
}

/// Fills the report's folder; it is not in its place yet.
void write_report(const std::filesystem::path& folder, ComparisonReport& report,
                  const std::vector<Contestant>& contestants, const Outcome& outcome,
                  PluginRegistry& registry, Reporter& reporter) {
  for (const DifferentFrames::Kept& kept : outcome.different.kept()) {
    if (kept.difference <= 0.0 || kept.picture.empty()) continue;
    std::string png = png_bytes(kept.picture);
    write_file_atomically(folder / fmt::format("{}{:06}.png", kPictureStart, kept.sequence), png);
    report.different_frames.push_back(
        {fmt::format("frame {}, difference {:.3f}", kept.sequence, kept.difference),
         std::move(png)});
  }
  if (!outcome.segmented.empty()) {
    report.segmented = {fmt::format("frame {}, as it came", outcome.segmented_sequence),
                        png_bytes(outcome.segmented)};
    for (const Contestant& contestant : contestants) {
      report.labels.push_back(
          labels_of(contestant, outcome.segmented, report.thresholds, registry, reporter));
    }
  }
  write_file_atomically(folder / kReportFile, to_html(report));
}

void check_inputs(const CompareOptions& options, const std::vector<Contestant>& contestants,
                  const std::optional<std::string>& source) {
  if (!options.json) return;
  std::vector<std::filesystem::path> inputs;
  for (const Contestant& contestant : contestants) {
    inputs.push_back(contestant.request.pipeline);
    if (contestant.request.calibration) inputs.push_back(*contestant.request.calibration);
  }
  if (options.truth) inputs.push_back(*options.truth);
  if (source) inputs.emplace_back(*source);
  check_report(*options.json, "--json", inputs);
}

/// The first thing that went wrong with any pipeline; empty when nothing did.
std::string first_failure(const std::vector<Contestant>& contestants, const Outcome& outcome) {
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const RunSummary& summary = outcome.summaries[i];
    if (!summary.clean()) return fmt::format("{}: {}", contestants[i].name, summary.first_error);
  }
  return {};
}

}  // namespace

ExitCode compare_command(const CompareOptions& options, const CommandLine& line) {
  check_counts(options);
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  std::vector<Contestant> contestants = build(options, registry, console, reporter);
  const std::optional<std::string> source = source_path(contestants.front().document);
  if (const std::string doubt = contestants.front().truth.doubt_about(source); !doubt.empty()) {
    console.line(doubt, Console::Tone::kWarning, "warning: ");
  }
  check_inputs(options, contestants, source);
  AtomicFolder folder(options.output, is_report_file);

  const Outcome outcome = run_all(contestants, options, console, reporter);
  reporter.print_totals();
  const std::string failure = first_failure(contestants, outcome);
  if (outcome.comparison.rows().empty()) {
    console.line(failure.empty() ? "no frame ever came from the source" : failure,
                 Console::Tone::kError, "error: ");
    return kFailed;
  }
  ComparisonReport report;
  report.pipelines = compared(contestants, outcome);
  report.has_truth = outcome.comparison.against_truth(0).frames() > 0;
  if (options.truth && !report.has_truth) {
    throw std::invalid_argument(
        fmt::format("--truth: none of the {} frames is in {}: expected the numbers of frames "
                    "counted from 0",
                    outcome.summaries.front().processed, options.truth->string()));
  }
  report.title = "Comparison of pipelines";
  report.facts = facts_of(contestants, outcome, options, source, report.has_truth);
  report.rows = outcome.comparison.rows();
  report.thresholds = options.thresholds;

  fmt::print(
      "{} frames through {} pipelines, tolerance {}\n\n{}\nagreement with {}, what it saw "
      "taken as the truth\n{}",
      outcome.summaries.front().taken(), contestants.size(),
      tolerance_text(outcome.comparison.against_truth(0).tolerance()),
      figures_text(report.pipelines, report.has_truth), contestants.front().name,
      agreement_text(report.pipelines));
  std::fflush(stdout);
  try {
    write_report(folder.path(), report, contestants, outcome, registry, reporter);
    folder.commit();
    if (options.json) {
      write_file_atomically(*options.json, json_text(comparison_json(contestants, report.pipelines,
                                                                     outcome, options, source)));
    }
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  fmt::print("\nreport: {}\n", (options.output / kReportFile).string());
  if (failure.empty()) return kFine;
  console.line("something failed during the run: " + failure, Console::Tone::kError, "error: ");
  return kFailed;
}

}  // namespace maggic::app
