#pragma once
/// A score as JSON. The keys are documented in docs/measure.md and stay as they are.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "maggic/palette.hpp"
#include "maggic/runner.hpp"
#include "maggic/score_figures.hpp"
#include "maggic/scorecard.hpp"

namespace maggic::app {

using OrderedJson = nlohmann::ordered_json;

/// `{"<name>": value or null, …}`, values to six digits behind the point.
OrderedJson to_json(const std::vector<Figure>& figures);

/// `[{"name": …, "figures": {…}}, …]`: every robot, then the ball under "ball".
OrderedJson objects_json(const Scorecard& card, const Palette& palette);

/// `{"judged": …, "processed": …, "dropped": …, "skipped": …, "failed": …}`.
OrderedJson frames_json(const Scorecard& card, const RunSummary& summary);

/// `{"distance": 2.5, "unit": "px"}`.
OrderedJson to_json(Tolerance tolerance);

/// Text as a person can read it, ended by a newline. Bytes that are no UTF-8, as a file's name may
/// have, become U+FFFD.
std::string json_text(const OrderedJson& json);

}  // namespace maggic::app
