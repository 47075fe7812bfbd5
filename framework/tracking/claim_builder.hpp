#pragma once
/// Claims: a candidate together with whose sighting it is. What the assignment chooses between.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "assignment/assignment.hpp"
#include "maggic/tracking_engine.hpp"
#include "tracking/candidate_generator.hpp"
#include "tracking/place_conflicts.hpp"
#include "tracking/robot_track.hpp"

namespace maggic::tracking {

struct Claim {
  int candidate = 0;
  int id = kUnknownId;
  int track = -1;  ///< The robot it continues; -1: by colour alone, or a new robot.
};

/// Why a candidate is not believed to be a robot whose colours are in no id table.
enum class UnknownRefusal { kNone, kNotReported, kHalf, kOutside, kShape };

/// Turns candidates and predicted tracks into claims, which are contenders for AssignmentSolver: a
/// claim's group is its team patch, its place the candidate, its identity the id within the team.
class ClaimBuilder {
 public:
  ClaimBuilder(const TrackingParameters& parameters, std::span<const LayoutModel> layouts);

  /// @param tracks predicted to this frame.
  /// @param candidates what geometry found; receives sightings that only motion explains too.
  /// @param field_limit_mm half extents of the area in which robots of unknown id are believed.
  void build(const TagBlobs& blobs, std::span<const RobotTrack> tracks, cv::Point2d field_limit_mm,
             std::vector<Candidate>& candidates);

  const std::vector<Claim>& claims() const { return claims_; }
  /// Of every claim, in the same order.
  std::span<const Contender> contenders() const { return contenders_; }
  /// Pairs of candidates that cannot both be robots.
  std::span<const std::pair<int, int>> conflicts() const { return conflicts_; }
  /// Whether two claims cannot both hold.
  bool exclude_each_other(int claim, int other) const;
  /// Whether the last frame held so much noise that the poorest claims were left out.
  bool is_cut_short() const { return is_cut_short_; }
  /// For what the last `build` was given.
  UnknownRefusal refusal_as_unknown(const Candidate& candidate) const;

 private:
  /// What of a track every candidate is compared with, in little memory.
  struct Expectation {
    cv::Point2d position_mm;
    double reach_mm = 0.0;           ///< A candidate farther off is not this robot.
    double squared_reach_mm2 = 0.0;  ///< A little more than that of `reach_mm`.
    double near_width_mm = 0.0;
    double heading_rad = 0.0;
    bool heading_known = false;
    Team team = Team::kBlue;
    int id = kUnknownId;
    int track = 0;
  };
  /// A track a candidate may continue.
  struct Near {
    const Expectation* expected = nullptr;
    double distance_mm = 0.0;
  };

  Expectation expectation_of(int track) const;
  void expect_tracks();
  void find_near(const Candidate& candidate);
  int identity_of(Team team, int id, int track) const;
  void add(int candidate, int id, int track, double score);
  void claim_by_colors(int candidate);
  void claim_by_motion(int candidate);
  void claim_as_unknown(int candidate);
  void claim_team_patch_alone(int blob);
  void claim_team_patch_of(int track);
  void claim_team_blobs_of(int track, const PatchModel& patch, double min_ratio, double max_ratio,
                           double cost);
  void claim_player_patches_of(int track);
  /// For a candidate at `distance_mm` from where the track is expected.
  double near_score(const Expectation& expected, double distance_mm,
                    const Candidate& candidate) const;
  double near_score(int track, const Candidate& candidate) const;
  bool shows_colors_of(const RobotTrack& track, const Candidate& candidate) const;
  const MetricBlob& blob_at(int index) const {
    return blobs_->all()[static_cast<std::size_t>(index)];
  }
  const LayoutModel& layout_at(int index) const {
    return layouts_[static_cast<std::size_t>(index)];
  }
  void keep_best();

  const TrackingParameters& parameters_;
  std::span<const LayoutModel> layouts_;
  const TagBlobs* blobs_ = nullptr;
  std::span<const RobotTrack> tracks_;
  cv::Point2d field_limit_mm_;
  std::vector<Candidate>* candidates_ = nullptr;
  std::vector<Claim> claims_;
  std::vector<Contender> contenders_;
  std::span<const std::pair<int, int>> conflicts_;
  std::vector<int> ids_;                              ///< Of all layouts, ascending, each once.
  std::array<std::vector<Expectation>, 2> expected_;  ///< Of the blue team and the yellow one.
  std::vector<Near> near_;                            ///< To the candidate being claimed.
  PlaceConflicts place_conflicts_;
  std::vector<int> by_score_;
  bool is_cut_short_ = false;
};

}  // namespace maggic::tracking
