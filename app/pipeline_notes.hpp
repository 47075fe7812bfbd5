#pragma once
/// What is looked at and said before a pipeline runs.

#include "app/commands.hpp"
#include "app/console.hpp"
#include "maggic/document.hpp"
#include "maggic/pipeline_builder.hpp"

namespace maggic::app {

/// The whole configuration of a request that was built without mistakes.
/// @throws ConfigError where an output would destroy something; see check_outputs.
Node checked_document(const PipelineRequest& request);

/// Prints the builder's notes, and one where the calibration is likely another camera's.
void print_notes(const BuiltPipeline& built, const PipelineOptions& options,
                 const PipelineRequest& request, Console& console);

}  // namespace maggic::app
