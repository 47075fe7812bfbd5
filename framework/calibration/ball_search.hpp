#pragma once
/// Which patch is the ball.

#include <optional>
#include <span>
#include <vector>

#include "calibration/color_naming.hpp"

namespace maggic::calibration {

struct BallSightings {
  int gray_threshold = 0;  ///< At which it was seen best.
  std::vector<std::optional<Patch>> by_frame;
  int count = 0;  ///< Frames with one.
};

/// The ball is what is part of no robot, round, of its size and near the palette's orange, and of
/// the hue that is most often there exactly once.
/// @param patches of each frame, at some threshold.
/// @param found,naming the robots of the same frames, at perhaps another threshold.
BallSightings find_ball(std::span<const FramePatches> patches, std::span<const FramePatches> found,
                        const Naming& naming, const TrackedPattern& pattern, const Palette& palette,
                        const TagMetric& metric);

}  // namespace maggic::calibration
