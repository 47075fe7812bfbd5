#pragma once
/// The report at the end of a run.

#include <string>

#include "maggic/runner.hpp"
#include "maggic/truth_score.hpp"

namespace maggic::app {

/// @param truth compared frames; left out of the report when it has none.
/// @param elapsed_s wall time of the run.
std::string summary_text(const RunSummary& summary, const TruthScore& truth, double elapsed_s);

}  // namespace maggic::app
