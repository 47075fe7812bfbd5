#pragma once
/// One function a kind; `check_conformance` picks among them.

#include <functional>

#include "findings.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"
#include "maggic/sink.hpp"
#include "maggic/source.hpp"
#include "maggic/testing.hpp"
#include "maggic/tracker.hpp"

namespace maggic::testing {

/// Makes one more configured and prepared instance of the plugin under test.
template <class Kind>
using Maker = std::function<StagePtr<Kind>()>;

void check_normalizer(const Maker<Normalizer>& make, Findings& findings);
void check_segmenter(const Maker<Segmenter>& make, Findings& findings);
void check_tracker(const Maker<Tracker>& make, Findings& findings);
void check_source(const Maker<Source>& make, Findings& findings);
void check_sink(const Maker<Sink>& make, Findings& findings);

/// Checks what `describe` declares, of a stage as constructed and of one configured with `yaml`.
/// @param construct makes a stage that was constructed only.
void check_describe(const Maker<Stage>& construct, std::string_view yaml, Findings& findings);

}  // namespace maggic::testing
