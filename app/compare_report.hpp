#pragma once
/// A comparison as a person reads it on a terminal.

#include <string>
#include <vector>

#include "maggic/comparison_report.hpp"

namespace maggic::app {

/// The main figures of every pipeline, a column each, and behind all but the first the difference
/// to it. Lines without any value are left out.
/// @param pipelines at least two, as below.
std::string figures_text(const std::vector<ComparedPipeline>& pipelines);

/// How far the others agree with the first, a column each.
std::string agreement_text(const std::vector<ComparedPipeline>& pipelines);

}  // namespace maggic::app
