#pragma once
/// The report at the end of a run.

#include <cstdint>
#include <string>

#include "maggic/runner.hpp"
#include "maggic/scorecard.hpp"

namespace maggic::app {

/// What was seen in the frames of a run; what was only predicted does not count.
struct Found {
  std::uint64_t frames = 0;
  std::uint64_t robots = 0;
  std::uint64_t balls = 0;

  void add(const Detections& detections);
};

/// @param truth compared frames; left out of the report when it has none.
/// @param elapsed_s wall time of the run.
std::string summary_text(const RunSummary& summary, const Found& found, const Scorecard& truth,
                         double elapsed_s);

}  // namespace maggic::app
