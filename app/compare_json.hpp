#pragma once
/// A comparison as JSON. The keys are documented in docs/measure.md and stay as they are.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/contestant.hpp"
#include "app/score_json.hpp"
#include "maggic/comparison.hpp"
#include "maggic/comparison_report.hpp"
#include "maggic/runner.hpp"

namespace maggic::app {

/// What is known once every frame went through every pipeline.
struct Outcome {
  Comparison comparison;
  DifferentFrames different;
  cv::Mat segmented;  ///< The most different frame, as it came.
  std::uint64_t segmented_sequence = 0;
  std::vector<RunSummary> summaries;  ///< One a pipeline.
};

OrderedJson comparison_json(const std::vector<Contestant>& contestants,
                            const std::vector<ComparedPipeline>& pipelines, const Outcome& outcome,
                            const std::optional<std::filesystem::path>& truth,
                            const std::optional<std::string>& source);

}  // namespace maggic::app
