#pragma once
/// Whether what colour stages say of whole boxes holds for the colours in them.

#include "findings.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"

namespace maggic::testing {

/// ColorNormalizer::bounds against `normalize`.
void check_bounds(const ColorNormalizer& normalizer, Findings& findings);

/// ColorSegmenter::label_of against `segment`.
void check_label_of(const ColorSegmenter& segmenter, Findings& findings);

}  // namespace maggic::testing
