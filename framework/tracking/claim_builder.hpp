#pragma once
/// Claims: a candidate together with whose sighting it is. What the assignment chooses between.

#include <span>
#include <utility>
#include <vector>

#include "maggic/tracking_engine.hpp"
#include "tracking/candidate_generator.hpp"
#include "tracking/robot_track.hpp"

namespace maggic::tracking {

struct Claim {
  int candidate = 0;
  int id = kUnknownId;
  int track = -1;  ///< The robot it continues; -1: by colour alone, or a new robot.
};

/// Why a candidate is not believed to be a robot whose colours are in no id table.
enum class UnknownRefusal { kNone, kNotReported, kHalf, kOutside, kShape };

/// Turns candidates and predicted tracks into claims with scores, groups and conflicts, as
/// AssignmentSolver wants them.
class ClaimBuilder {
 public:
  ClaimBuilder(const TrackingParameters& parameters, std::span<const LayoutModel> layouts)
      : parameters_(parameters), layouts_(layouts) {}

  /// @param tracks predicted to this frame.
  /// @param candidates what geometry found; receives sightings that only motion explains too.
  /// @param field_limit_mm half extents of the area in which robots of unknown id are believed.
  void build(const TagBlobs& blobs, std::span<const RobotTrack> tracks, cv::Point2d field_limit_mm,
             std::vector<Candidate>& candidates);

  const std::vector<Claim>& claims() const { return claims_; }
  std::span<const double> scores() const { return scores_; }
  std::span<const int> groups() const { return groups_; }
  std::span<const std::pair<int, int>> conflicts() const { return conflicts_; }
  /// Whether the last frame held so much noise that the poorest claims were left out.
  bool is_cut_short() const { return is_cut_short_; }
  /// For what the last `build` was given.
  UnknownRefusal refusal_as_unknown(const Candidate& candidate) const;

 private:
  void add(int candidate, int id, int track, double score);
  void claim_by_colors(int candidate);
  void claim_by_motion(int candidate);
  void claim_as_unknown(int candidate);
  void claim_team_patch_alone(int blob);
  void claim_team_patch_of(int track);
  void claim_team_blobs_of(int track, const PatchModel& patch, double min_ratio, double max_ratio,
                           double cost);
  void claim_player_patches_of(int track);
  double near_score(const RobotTrack& track, const Candidate& candidate) const;
  double distance_mm(const RobotTrack& track, const Candidate& candidate) const;
  bool is_gated(const RobotTrack& track, const Candidate& candidate) const;
  bool shows_colors_of(const RobotTrack& track, const Candidate& candidate) const;
  const MetricBlob& blob_at(int index) const {
    return blobs_->all()[static_cast<std::size_t>(index)];
  }
  const LayoutModel& layout_at(int index) const {
    return layouts_[static_cast<std::size_t>(index)];
  }
  void keep_best();
  void find_conflicts();
  /// @param window_mm robots farther apart than this share no blob.
  bool exclude_each_other(const Claim& a, const Claim& b, double window_mm) const;

  const TrackingParameters& parameters_;
  std::span<const LayoutModel> layouts_;
  const TagBlobs* blobs_ = nullptr;
  std::span<const RobotTrack> tracks_;
  cv::Point2d field_limit_mm_;
  std::vector<Candidate>* candidates_ = nullptr;
  std::vector<Claim> claims_;
  std::vector<double> scores_;
  std::vector<int> groups_;
  std::vector<std::pair<int, int>> conflicts_;
  std::vector<int> by_score_;
  std::vector<int> by_x_;
  std::vector<std::pair<int, int>> by_identity_;
  bool is_cut_short_ = false;
};

}  // namespace maggic::tracking
