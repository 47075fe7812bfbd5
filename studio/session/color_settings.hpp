#pragma once
/// The part of a pipeline's document that says which colour is which: what the page shows and
/// changes of it.

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "maggic/document.hpp"
#include "maggic/pipeline.hpp"

namespace maggic::studio {

/// The colour stages in use and what they say of themselves, defaults included.
struct ColorStages {
  std::string normalizer;
  Node normalizer_values;
  std::string segmenter;
  Node segmenter_values;
};

ColorStages color_stages(const PipelineParts& parts);

/// `normalizer`, `segmenter`, and of the segmenter `gray_threshold`, `hue_of`, `pivots`, `exclude`,
/// `boxes`, null where it has none.
nlohmann::json color_settings(const ColorStages& stages);

/// Name of the plugin in a section of a document whose stages are written out as `{plugin: {…}}`.
std::string plugin_in(const Node& document, std::string_view section);

/// Lays a change of some of these settings on a document. Colours keep their order, where the first
/// wins; new ones come last.
/// @param document a merged one, whose stages are written out.
/// @throws BadRequest for what is no object, a setting there is none of, or a value too strange to
///   be written down. Whether the stages have the settings, and take their values, is judged when
///   the pipeline is built.
void change_colors(Node& document, const nlohmann::json& change);

/// Writes the numbers of the stages in use over those that a calibration file has of them.
/// @param pipeline the document without the calibration: a colour of it that is not in use is taken
///   away by `~`.
void write_colors(Node& calibration, const Node& pipeline, const ColorStages& stages);

}  // namespace maggic::studio
