#pragma once
/// Why there is, or is not, an object where a person sees one: a pixel's way through the stages.

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/frame_result.hpp"
#include "maggic/pipeline.hpp"

namespace maggic {

/// What one stage made of a point.
struct StageAnswer {
  std::string stage;  ///< "pixel", "light", "scan", "normalized", "label", "blob", "tracker".
  std::string text;   ///< One sentence or several, one a line.
};

/// Follows the pixel from its colour to the object it belongs to, or to the stage that dropped it:
/// the last answer is that stage's, with its rule and the numbers of the rule. "scan" answers only
/// for a pixel that was not looked at, and is then the last.
/// @param pipeline one that has just processed `result`: trackers and image stages answer for their
///   latest frame only.
/// @param pixel_px column and row, within the frame. @throws std::out_of_range otherwise.
std::vector<StageAnswer> explain_point(const Pipeline& pipeline, const FrameResult& result,
                                       cv::Point pixel_px);

}  // namespace maggic
