#pragma once
/// Brown and purple things that lie on and around the field and are neither tag nor ball.

#include <cstdint>
#include <vector>

#include <opencv2/core/types.hpp>

#include "scene.hpp"

namespace maggic::synthetic_match {

/// Wooden strips beyond the wall, cables, and scraps of paper from 12 to 150 mm, some as large as a
/// tag. Their colours are brown and purple alone, so no two of them make a robot: a robot has a
/// team colour. From the floor upwards; deterministic by seed.
std::vector<FloorPatch> brown_and_purple_clutter(cv::Size2d field_mm, std::uint64_t seed);

}  // namespace maggic::synthetic_match
