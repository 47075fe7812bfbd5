#pragma once
/// A robot that may be there: some blobs read as the patches of one layout.

#include <array>

#include "maggic/detections.hpp"
#include "tracking/pose.hpp"

namespace maggic::tracking {

struct Candidate {
  Candidate() { blobs.fill(-1); }

  Team team = Team::kBlue;
  int layout = 0;
  /// Metric blob of each patch, team patch first; -1 where it was not found.
  std::array<int, kMaxPatches> blobs;
  int found = 0;              ///< How many patches were found.
  bool complete = false;      ///< All of them.
  bool has_half = false;      ///< One patch is half of a blob: rough place, right colour.
  int color_id = kUnknownId;  ///< What the id table says of the colours of a complete candidate.
  Pose pose;
  bool heading_known = true;     ///< False: only the line of the heading, or nothing, is known.
  double position_sigmas = 1.0;  ///< Measuring noise in multiples of the configured one …
  double heading_sigmas = 1.0;   ///< … and that of the heading; 0: none was measured.
  double team_cost = 0.0;        ///< Of the team patch's size, outline and direction.
  double score = 0.0;  ///< How well the blobs fit the pattern, colours aside; fit_score.hpp.
};

}  // namespace maggic::tracking
