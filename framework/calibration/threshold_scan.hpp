#pragma once
/// Patches at a ladder of gray thresholds, and what they tell before any colour has a name.

#include <optional>
#include <span>
#include <vector>

#include "calibration/chroma_frame.hpp"
#include "calibration/color_naming.hpp"
#include "maggic/tag_layout.hpp"

namespace maggic::calibration {

/// What one threshold gives in each frame.
struct ThresholdLevel {
  int gray_threshold = 0;
  std::vector<FramePatches> frames;
  /// Patterns found a frame, less something for what has a tag's size and is part of none.
  double worth = 0.0;
};

/// Millimetres a pixel that can be meant at all.
struct ScaleRange {
  double min_mm_per_px = 0.0;
  double max_mm_per_px = 0.0;
};

struct ThresholdScan {
  std::vector<ThresholdLevel> levels;  ///< Thresholds ascending.
  std::optional<TagMetric> metric;     ///< Nothing: no pattern was found anywhere.
  std::size_t best = 0;                ///< Level in the middle of those that find most patterns.
};

/// The thresholds looked at: each about a fifth above the last.
std::span<const int> threshold_ladder();

/// @param frames at least one.
/// @param thresholds ascending, at least one.
ThresholdScan scan_thresholds(std::span<const ChromaFrame> frames, std::span<const int> thresholds,
                              std::span<const TagLayout> layouts, const ScaleRange& scales);

/// Patches and candidates of further frames at one threshold.
std::vector<FramePatches> find_candidates(std::span<const ChromaFrame> frames, int gray_threshold,
                                          std::span<const TagLayout> layouts,
                                          const TagMetric& metric);

}  // namespace maggic::calibration
