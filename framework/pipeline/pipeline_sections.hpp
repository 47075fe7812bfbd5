#pragma once
/// A pipeline file's sections, and how a calibration and the command line are laid over them.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/pipeline_builder.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// A section that names one plugin.
struct StageSection {
  std::string_view key;
  StageKind kind;
};
inline constexpr std::array kStageSections{
    StageSection{"source", StageKind::kSource}, StageSection{"normalizer", StageKind::kNormalizer},
    StageSection{"segmenter", StageKind::kSegmenter}, StageSection{"tracker", StageKind::kTracker}};

/// Every section a pipeline file may have.
const std::vector<std::string>& known_sections();

/// Writes the shorter forms out: a plugin's bare name becomes a map from it to nothing, a missing
/// normalizer becomes `none`, missing sinks an empty list. What has a wrong shape stays.
void write_out_sections(Node& document);

/// Parameters in a calibration for a plugin the pipeline does not run.
struct UnusedBlock {
  StageKind kind;
  Node::Entry block;
  std::string reason;
};

/// A request as one document.
struct MergedRequest {
  Node document;
  std::vector<UnusedBlock> unused;
  std::vector<Mistake> mistakes;  ///< In the calibration's shape and in assignments.
};

/// @throws ConfigError when a file cannot be read as a map.
MergedRequest merge_request(const PipelineRequest& request);

/// "calibration for segmenter 'yuv_boxes' is not used: …".
Mistake note_of(const UnusedBlock& unused);

}  // namespace maggic
