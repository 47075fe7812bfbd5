#pragma once
/// Notes on borders between colours that cut through what the camera sees.

#include "app/console.hpp"
#include "maggic/border_check.hpp"
#include "maggic/pipeline_builder.hpp"

namespace maggic::app {

/// Prints one note a doubtful border. @return whether there was any.
bool print_border_notes(const Pipeline& pipeline, const BlobColors& colors, Console& console);

/// Looks at the first frames of the pipeline's source, writing nothing, and prints the notes; or
/// one that says why nothing could be looked at. A source that gives no frame is waited for a few
/// seconds.
void look_at_source(BuiltPipeline& built, Console& console);

}  // namespace maggic::app
