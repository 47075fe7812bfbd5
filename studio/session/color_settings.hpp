#pragma once
/// The part of a pipeline's document that says which colour is which: what the page shows and
/// changes of it.

#include <nlohmann/json.hpp>

#include "maggic/document.hpp"
#include "maggic/pipeline.hpp"

namespace maggic::studio {

/// `normalizer`, `segmenter`, and of the segmenter `gray_threshold`, `hue_of`, `pivots`, `exclude`,
/// `boxes`, null where it has none. The stages say so themselves, so defaults are in it.
nlohmann::json color_settings(const PipelineParts& parts);

/// Lays a change of some of these settings on a document. Colours keep their order, where the first
/// wins; new ones come last.
/// @param document a merged one, whose stages are written out as `{plugin: {…}}`.
/// @param settings those in use.
/// @throws BadRequest for what is no object, a setting there is none of, or a value too strange to
/// be
///   written down. Values are judged when the pipeline is built.
void change_colors(Node& document, const nlohmann::json& change, const nlohmann::json& settings);

/// Writes the numbers of the stages in use over those that a calibration file has of them.
/// @param pipeline the document without the calibration: a colour of it that is not in use is taken
///   away by `~`.
void write_colors(Node& calibration, const Node& pipeline, const PipelineParts& parts);

}  // namespace maggic::studio
