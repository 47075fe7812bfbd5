#pragma once
/// A comparison as a person reads it on a terminal.

#include <string>
#include <string_view>
#include <vector>

#include "maggic/comparison_report.hpp"

namespace maggic::app {

/// Figures of every pipeline, a column each, and behind all but the first the difference to it.
std::string figures_text(const std::vector<ComparedPipeline>& pipelines, bool has_truth);

/// How far the others agree with the first, a column each.
std::string agreement_text(const std::vector<ComparedPipeline>& pipelines);

}  // namespace maggic::app
