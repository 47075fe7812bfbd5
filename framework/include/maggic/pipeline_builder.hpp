#pragma once
/// From a pipeline file to a pipeline with its source and sinks.
///
/// Sections of a pipeline file (all but `source`, `segmenter` and `tracker` may be left out):
///
///     palette:    {teal: [0, 128, 128]}      # added to the standard colours
///     plugins:    [folder, …]                # beside this file; searched after the usual ones
///     source:     synthetic_match            # a plugin by name, or
///     normalizer: {weighted: {…}}            # … with its parameters
///     segmenter:  {hue_pivots: {…}}
///     field:      {…}
///     blobs:      {…}
///     light:      {…}                        # follow light that changes; light_follower.hpp
///     tracker:    {two_tag: {…}}
///     sinks:      [{jsonl: {path: out.jsonl}}, …]
///
/// A calibration file has the same sections. Its numbers for a plugin apply when the pipeline runs
/// that plugin; blocks for other plugins are checked, unused, and mentioned in a note, so one
/// calibration file can serve an A/B test. It never changes which plugin runs. Its sinks' numbers
/// apply to the pipeline's sinks of that plugin, its plugin folders are added to the pipeline's,
/// and sections it leaves empty change nothing.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/pipeline.hpp"
#include "maggic/plugin_registry.hpp"

namespace maggic {

/// What the user asked for.
struct PipelineRequest {
  std::filesystem::path pipeline;
  std::optional<std::filesystem::path> calibration;
  std::vector<std::string> assignments;  ///< `path.to.key=value`, applied last, in order.
  /// Replaces the pipeline's source section: a map of one plugin name to its parameters, merged
  /// over the pipeline's own parameters where it names the same plugin.
  std::optional<Node> source;
  std::vector<Node> extra_sinks;  ///< Added to the pipeline's, each a map of one plugin name.
};

/// A pipeline ready to run.
struct BuiltPipeline {
  std::unique_ptr<Pipeline> pipeline;
  NamedStage<Source> source;
  std::vector<NamedStage<Sink>> sinks;
  std::vector<Mistake> notes;  ///< Nothing wrong, but worth a word (unused calibration blocks).
};

/// The file with calibration, source and assignments laid over it, not yet checked against plugins.
/// @throws ConfigError.
Node merged_document(const PipelineRequest& request, std::vector<Mistake>& notes);

/// Creates, reads and prepares every stage; opens no device and reads no frame.
/// @throws ConfigError with all mistakes of all sections at once; a plugin that cannot be loaded
///   is a mistake at the place that names it.
BuiltPipeline build_pipeline(const PipelineRequest& request, PluginRegistry& registry,
                             Reporter& reporter);

/// The frame path's stages, palette and field alone, ready to work, without the colour table whose
/// compilation takes longest: for tools that ask the stages themselves.
/// @throws ConfigError with every mistake of the whole file, as build_pipeline does.
PipelineParts build_parts(const PipelineRequest& request, PluginRegistry& registry,
                          Reporter& reporter);

/// A pipeline from a document, for tools and tests.
BuiltPipeline build_pipeline(const Node& document, PluginRegistry& registry, Reporter& reporter);

}  // namespace maggic
