#pragma once
/// The pipelines that `maggic compare` compares.

#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/truth_option.hpp"
#include "maggic/comparison_report.hpp"
#include "maggic/document.hpp"
#include "maggic/pipeline_builder.hpp"

namespace maggic::app {

struct Contestant {
  std::string name;  ///< "A maggic_3v3"; the letter keeps one pipeline with two calibrations apart.
  PipelineRequest request;
  Node document;
  BuiltPipeline built;  ///< Without sinks: a comparison writes over no log.
  TruthOption truth;    ///< The same for all, in the labels of this pipeline's palette.
};

/// Builds every pipeline that was asked for, and prints what there is to note.
/// @throws std::invalid_argument for a wrong number of pipelines or calibrations, otherwise as
///   make_request, build_pipeline and TruthOption do.
std::vector<Contestant> build_contestants(const CompareOptions& options, PluginRegistry& registry,
                                          Console& console, Reporter& reporter);

/// What its segmenter makes of one picture, at each of the thresholds where it uses one.
/// @param bgr CV_8UC3. @throws std::exception what a stage throws.
MethodLabels labels_of(const Contestant& contestant, const cv::Mat& bgr,
                       const std::vector<int>& thresholds, PluginRegistry& registry,
                       Reporter& reporter);

}  // namespace maggic::app
