#pragma once
/// All robots over time: which claim continues which track, and what is reported.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assignment/assignment.hpp"
#include "maggic/tracker.hpp"
#include "maggic/tracking_engine.hpp"
#include "tracking/candidate_generator.hpp"
#include "tracking/claim_builder.hpp"
#include "tracking/robot_evidence.hpp"
#include "tracking/robot_track.hpp"

namespace maggic::tracking {

class RobotTracker {
 public:
  RobotTracker(const TrackingParameters& parameters, std::span<const LayoutModel> layouts);

  /// Motion and identities are forgotten.
  void forget() { tracks_.clear(); }
  /// Moves on by `dt_s` and matches the frame's blobs.
  void track(const TrackerInput& input, double dt_s);
  /// Appends robots in the order Detections states.
  void report(const TrackerInput& input, Detections& out);

  std::span<const RobotTrack> tracks() const { return tracks_; }
  /// Whether the last frame held so much noise that the least likely robots were left out.
  bool is_cut_short() const { return is_cut_short_; }
  /// Whether a blob of this colour may be a patch of any robot.
  bool may_be_patch(Label label) const {
    return blobs_.is_team_color(label) || blobs_.may_be_player(label);
  }
  /// The robot that has the blob among its patches, and as which one; empty when none has.
  std::string explain_owner(const TrackerInput& input, std::size_t blob,
                            const Palette& palette) const;
  /// Why no robot has the blob among its patches. Both after `track`, with the same input.
  std::string explain_refusal(const TrackerInput& input, std::size_t blob,
                              const Palette& palette) const;
  /// Half side of the robot's body: its tag and a rim.
  double half_body_mm(const RobotTrack& track) const;

 private:
  RobotEvidence evidence() const;
  void continue_tracks();
  int motion_source(const Claim& claim) const;
  void keep_unseen_tracks(cv::Point2d limit_mm);
  bool overlaps_kept(const RobotTrack& track) const;
  void limit_team(Team team);
  void describe_robot(const TrackerInput& input, const RobotTrack& track,
                      RobotDetection& robot) const;
  double confidence(const RobotTrack& track) const;
  double rate(const Candidate& candidate, int id) const;
  const Candidate& candidate_of(const Claim& claim) const {
    return candidates_[static_cast<std::size_t>(claim.candidate)];
  }

  const TrackingParameters& parameters_;
  std::span<const LayoutModel> layouts_;
  TagBlobs blobs_;
  CandidateGenerator generator_;
  ClaimBuilder claims_;
  AssignmentSolver solver_;
  std::vector<Candidate> candidates_;
  std::vector<int> chosen_;
  std::vector<int> sources_;  ///< Track each chosen claim continues; -1: none.
  std::vector<char> taken_;   ///< Tracks that were continued.
  std::vector<RobotTrack> tracks_;
  std::vector<RobotTrack> next_;
  bool is_cut_short_ = false;
};

}  // namespace maggic::tracking
