#pragma once
/// Which colour of the palette each patch shows, learnt from the tag pattern.

#include <span>
#include <vector>

#include "calibration/pattern_candidates.hpp"
#include "maggic/palette.hpp"
#include "maggic/tracker.hpp"

namespace maggic::calibration {

/// What was found in one frame before any colour has a name.
struct FramePatches {
  std::vector<Patch> patches;
  std::vector<PatternCandidate> candidates;
};

/// A robot whose patches have names.
struct NamedRobot {
  const PatternCandidate* candidate = nullptr;  ///< In the frame's `candidates`.
  Label team = kBackground;
  bool is_listed = false;  ///< Its player colours are in the id table.
};

struct NamedFrame {
  std::vector<NamedRobot> robots;
  std::vector<Label> label_of_patch;  ///< kBackground: part of no robot.
};

struct Naming {
  std::vector<NamedFrame> frames;  ///< One for each frame given.
  double robots = 0.0;             ///< Of all frames.
};

/// Gives hue clusters the names under which most patterns become robots: a team colour each and
/// listed player colours, no identity twice a team, and hues near those the palette draws its
/// colours in.
Naming name_colors(std::span<const FramePatches> frames, const TrackedPattern& pattern,
                   const Palette& palette);

}  // namespace maggic::calibration
