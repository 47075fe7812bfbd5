#pragma once
/// Blobs in a tag's or the ball's colour, size and shape that are neither.

#include <set>
#include <span>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "calibration/ball_search.hpp"
#include "maggic/pipeline.hpp"

namespace maggic::calibration {

/// A team's colour and the player colours that go with it, in the layout's order.
using Identity = std::pair<Label, std::vector<Label>>;

Identity identity_of(const RobotDetection& robot, const TrackedPattern& pattern);

struct Stray {
  cv::Point2d centroid_px;
  double area_px = 0.0;
};

/// Runs the frames and lists, for each, the blobs on the field of a team's colour that are part of
/// no complete robot, and those of the ball's colour away from where the ball is known to be.
/// Frames in which no ball was seen are not asked for balls. A robot of an identity that is not
/// `known` is none: scraps can lie like a tag.
/// @param ball of the same frames.
std::vector<std::vector<Stray>> find_strays(Pipeline& pipeline, std::span<const cv::Mat> frames,
                                            const BallSightings& ball,
                                            const TrackedPattern& pattern,
                                            const std::set<Identity>& known);

}  // namespace maggic::calibration
