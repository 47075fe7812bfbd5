#include "app/pipeline_notes.hpp"

#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "app/pipeline_options.hpp"

namespace maggic::app {

Node checked_document(const PipelineRequest& request) {
  std::vector<Mistake> known_notes;
  Node document = merged_document(request, known_notes);
  std::vector<std::filesystem::path> configuration{request.pipeline};
  if (request.calibration) configuration.push_back(*request.calibration);
  check_outputs(document, configuration);
  return document;
}

void print_notes(const BuiltPipeline& built, const PipelineOptions& options,
                 const PipelineRequest& request, Console& console) {
  for (const Mistake& note : built.notes) {
    console.line(note.to_string(), Console::Tone::kWarning, "note: ");
  }
  if (options.source && *options.source != "synthetic" && !options.calibration) {
    console.line(fmt::format("no --calibration: corners and colours are those of {}, positions in "
                             "millimetres may mean nothing for this camera",
                             request.pipeline.string()),
                 Console::Tone::kWarning, "note: ");
  }
}

}  // namespace maggic::app
