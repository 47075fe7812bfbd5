#pragma once
/// One robot over time.

#include <boost/container/static_vector.hpp>

#include "maggic/tracking_engine.hpp"
#include "tracking/angles.hpp"
#include "tracking/candidate.hpp"
#include "tracking/motion_filter.hpp"

namespace maggic::tracking {

/// So many frames in a row must speak against a robot's id before it is given up.
inline constexpr int kSwitchFrames = 5;
/// … when they name no other id: a lighting change must not cost a robot its id at once.
inline constexpr int kForgetFrames = 30;

struct RobotTrack {
  Team team = Team::kBlue;
  int id = kUnknownId;
  int layout = 0;
  PositionFilter position;
  HeadingFilter heading;
  bool heading_known = false;     ///< False: front and back cannot be told apart (any more).
  bool heading_measured = false;  ///< In the last frame.
  double unseen_s = 0.0;          ///< Since the last sighting.
  int seen_frames = 0;
  int missed_frames = 0;         ///< In a row; 0 while seen.
  int agreeing_frames = 0;       ///< Frames whose colours named this id.
  int contrary_id = kUnknownId;  ///< What the colours said instead in the last frames …
  int contrary_frames = 0;       ///< … and in how many of them, in a row.
  double confidence = 0.0;       ///< When last seen.
  boost::container::static_vector<Label, kMaxPatches> player_colors;
  int candidate = -1;  ///< What it was seen as in this frame.

  Pose pose() const { return {position.position_mm(), heading.heading_rad()}; }
  void predict(double dt_s, const TrackingParameters& parameters);
  /// How far from the prediction the robot may turn up and still be taken for this one by its
  /// place alone.
  double gate_mm(const TrackingParameters& parameters) const;
  /// How far it can have got since it was last seen.
  double max_travel_mm(const TrackingParameters& parameters) const;
  /// Whether the colours have spoken against the id for long enough, last with `color_id`.
  bool is_refuted_by(int color_id) const;
  /// Starts from a sighting, or takes it as a measurement.
  void start(const Candidate& sighting, int claimed_id, const TrackingParameters& parameters);
  void update(const Candidate& sighting, int claimed_id, const TrackingParameters& parameters);

 private:
  bool is_put_right_by(const Candidate& sighting) const;
  void correct_heading(const Candidate& sighting, double noise_rad);
  void note_colors(const Candidate& sighting, int claimed_id);
};

}  // namespace maggic::tracking
