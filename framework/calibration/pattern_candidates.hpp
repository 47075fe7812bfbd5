#pragma once
/// Sets of patches that have the shape of a robot's tag, whatever their colours.

#include <optional>
#include <span>
#include <vector>

#include <boost/container/static_vector.hpp>

#include "calibration/patch_finder.hpp"
#include "calibration/tag_metric.hpp"
#include "maggic/tag_layout.hpp"

namespace maggic::calibration {

/// Patches read as one robot of `layout`.
struct PatternCandidate {
  int layout = 0;
  /// Index of the patch seen for each patch of the layout, in the layout's order.
  boost::container::static_vector<int, kMaxPatches> patches;
  double mm_per_px = 0.0;  ///< Scale at which it fits best.
  double misfit = 0.0;     ///< 0: exact; about 1 at the limit of what is believed.
};

/// Every reading of the patches as robots at any scale, or, once a metric is known, at that one.
/// Two readings of one pair (which half is the team's?) are both given.
std::vector<PatternCandidate> list_candidates(std::span<const Patch> patches,
                                              std::span<const TagLayout> layouts,
                                              const std::optional<TagMetric>& metric);

/// Best first without sharing patches: as many candidates as nearest-first choice finds.
std::vector<const PatternCandidate*> choose_apart(std::span<const PatternCandidate> candidates,
                                                  std::size_t patch_count);

}  // namespace maggic::calibration
