#pragma once
/// How well blobs fit a pattern, on one scale for all candidates.
///
/// A score is roughly twice a log-likelihood ratio: each patch found earns a constant, what does
/// not fit about it costs. Constants matter by their order: one patch more always beats a somewhat
/// better fit of the others, so that a three-tag robot is never read as a two-tag one, and pairs of
/// neighbouring robots are never crossed.

#include "tracking/layout_model.hpp"
#include "tracking/metric_blob.hpp"

namespace maggic::tracking {

inline constexpr double kPatchScore = 10.0;
inline constexpr double kHalfPatchScore = 5.0;  ///< For half of a merged blob.
inline constexpr double kListedScore = 4.0;     ///< The colours are in the id table.
inline constexpr double kUnlistedCost = 4.0;
inline constexpr double kMissingPatchCost = 3.0;
inline constexpr double kNearPlaceScore = 4.0;  ///< At most, for being where motion predicts.
inline constexpr double kNearHeadingScore = 2.0;
inline constexpr double kHeldCost = 3.0;      ///< The id comes from motion, not from colours.
inline constexpr double kContraryCost = 9.0;  ///< Colours and motion disagree about the id.

/// Cost of area and outline of one blob read as `patch`.
double outline_cost(const PatchModel& patch, const MetricBlob& blob);
/// Cost of the blob's direction, with the pattern's heading known.
double direction_cost(const PatchModel& patch, const MetricBlob& blob, double heading_rad);

/// Cost of a blob that lies off the place the pose gives its patch. At `max_error_mm`, 3 sigma.
double place_cost(double error_mm, double max_error_mm);

/// Whether a lone blob looks so much like the patch that a robot may be reported from it alone.
bool is_convincing_alone(const PatchModel& patch, const MetricBlob& blob);

}  // namespace maggic::tracking
