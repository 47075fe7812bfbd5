#pragma once
/// From names and flags to a PipelineRequest and a plugin registry.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "maggic/document.hpp"
#include "maggic/pipeline_builder.hpp"
#include "maggic/plugin_registry.hpp"

namespace maggic::app {

/// Folders searched for pipelines given by name: `pipelines` here, then the shipped ones.
std::vector<std::filesystem::path> pipeline_folders();

/// The file `name` stands for: itself where there is such a path, else `<folder>/<name>` or
/// `<folder>/<name>.yaml` in the first of `folders` that has it.
/// @throws ConfigError naming what was looked for and which names are known.
std::filesystem::path find_configuration(std::string_view name,
                                         const std::vector<std::filesystem::path>& folders);

/// @throws ConfigError as find_configuration, std::exception for a source that cannot be meant.
PipelineRequest make_request(const PipelineOptions& options);

/// A sink entry `{<plugin>: {path: <path>}}`; mistakes in it are told as being in `flag`.
Node sink_node(std::string_view plugin, std::string_view path, std::string_view flag);

/// Refuses outputs that would destroy something: a sink's `path` that is the very file the source
/// reads, that another sink writes too, or that is one of the `configuration` files.
/// @param document a pipeline, merged and without mistakes.
/// @throws ConfigError naming both sides.
void check_outputs(const Node& document,
                   const std::vector<std::filesystem::path>& configuration = {});

/// Refuses a report that could not be written, or that would destroy one of `inputs`.
/// @throws ConfigError naming `flag`.
void check_report(const std::filesystem::path& report, std::string_view flag,
                  const std::vector<std::filesystem::path>& inputs);

/// What the source of `document` reads: a path, URL or device; nothing when it has no `path`.
std::optional<std::string> source_path(const Node& document);

/// Whether a sink of `document` writes to standard output.
bool writes_to_stdout(const Node& document);

PluginRegistry make_registry(const CommandLine& line);

}  // namespace maggic::app
