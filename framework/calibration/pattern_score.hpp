#pragma once
/// What a whole pipeline makes of frames, judged by the tag pattern alone.

#include <functional>
#include <span>

#include <opencv2/core/mat.hpp>

#include "maggic/calibration.hpp"
#include "maggic/pipeline_builder.hpp"

namespace maggic::calibration {

/// Runs the frames, each on its own: no motion carries over.
/// @throws StageError when a stage fails.
/// @param on_frame called after each processed frame, whose `sequence` is its index; may be empty.
PatternScore score_by_pattern(Pipeline& pipeline, std::span<const cv::Mat> frames,
                              const std::function<void(const FrameResult&)>& on_frame = {});

}  // namespace maggic::calibration
