/// `maggic compare`: several pipelines on the same frames, against the truth and each other.

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
#include "app/compare_json.hpp"
#include "app/compare_report.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/contestant.hpp"
#include "app/pipeline_options.hpp"
#include "app/progress.hpp"
#include "app/score_report.hpp"
#include "app/stop_signals.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/atomic_folder.hpp"
#include "maggic/comparison_report.hpp"
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

bool is_report_file(std::string_view name) {
  return name == kReportFile || (name.starts_with(kPictureStart) && name.ends_with(".png"));
}

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
  Outcome outcome{Comparison(contestants.size(), contestants.front().truth.tolerance()),
                  DifferentFrames(kDifferentFrames, kFramesApart)};
  std::vector<Pipeline*> pipelines;
  pipelines.reserve(contestants.size());
  for (Contestant& contestant : contestants) pipelines.push_back(contestant.built.pipeline.get());

  Progress progress(console, options.frames);
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
        const FrameDifference difference = outcome.comparison.add(entries);
        outcome.different.offer(any->frame.sequence, difference, [&] {
          const auto& kept = outcome.different.kept();
          if (outcome.segmented.empty() || kept.empty() || difference > kept.front().difference) {
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
    if (kept.difference == FrameDifference() || kept.picture.empty()) continue;
    std::string png = png_bytes(kept.picture);
    write_file_atomically(folder / fmt::format("{}{:06}.png", kPictureStart, kept.sequence), png);
    report.different_frames.push_back(
        {fmt::format("frame {}: {} object{} unlike, the others {:.2f} mm apart (RMSE)",
                     kept.sequence, kept.difference.objects,
                     kept.difference.objects == 1 ? "" : "s", kept.difference.apart_mm),
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
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  std::vector<Contestant> contestants = build_contestants(options, registry, console, reporter);
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
      "{} frame{} through {} pipelines, tolerance {}\n\n{}\nagreement with {}, what it saw "
      "taken as the truth\n{}",
      outcome.summaries.front().taken(), outcome.summaries.front().taken() == 1 ? "" : "s",
      contestants.size(), tolerance_text(outcome.comparison.against_truth(0).tolerance()),
      figures_text(report.pipelines), contestants.front().name, agreement_text(report.pipelines));
  std::fflush(stdout);
  try {
    write_report(folder.path(), report, contestants, outcome, registry, reporter);
    folder.commit();
    if (options.json) {
      write_file_atomically(*options.json,
                            json_text(comparison_json(contestants, report.pipelines, outcome,
                                                      options.truth, source)));
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
