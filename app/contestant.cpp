#include "app/contestant.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/pipeline_options.hpp"
#include "maggic/label_picture.hpp"
#include "maggic/png.hpp"

namespace maggic::app {
namespace {

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
  std::string name =
      fmt::format("{} {}", static_cast<char>('A' + index % 26), request.pipeline.stem().string());
  if (own_calibration && request.calibration) {
    name += fmt::format(" ({})", request.calibration->stem().string());
  }
  return name;
}

}  // namespace

std::vector<Contestant> build_contestants(const CompareOptions& options, PluginRegistry& registry,
                                          Console& console, Reporter& reporter) {
  check_counts(options);
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

}  // namespace maggic::app
