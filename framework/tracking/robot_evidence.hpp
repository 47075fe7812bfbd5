#pragma once
/// What the robot tracker went by in its last frame, laid open to those who explain it.

#include <span>

#include "maggic/tracking_engine.hpp"
#include "tracking/candidate_generator.hpp"
#include "tracking/claim_builder.hpp"
#include "tracking/robot_track.hpp"

namespace maggic::tracking {

struct RobotEvidence {
  const TrackingParameters& parameters;
  std::span<const LayoutModel> layouts;
  const TagBlobs& blobs;
  const CandidateGenerator& generator;
  const ClaimBuilder& claims;
  std::span<const Candidate> candidates;
  std::span<const int> chosen;         ///< Claims that held.
  std::span<const RobotTrack> tracks;  ///< As reported.
};

}  // namespace maggic::tracking
