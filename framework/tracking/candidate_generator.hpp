#pragma once
/// Every robot the blobs of a frame could show, judged by geometry and colour alone.

#include <array>
#include <span>
#include <vector>

#include "maggic/tracking_engine.hpp"
#include "tracking/candidate.hpp"
#include "tracking/layout_model.hpp"
#include "tracking/metric_blob.hpp"

namespace maggic::tracking {

/// Blobs of one frame in millimetres, at the height of the tags, sorted by x.
class TagBlobs {
 public:
  TagBlobs(const TrackingParameters& parameters, std::span<const LayoutModel> layouts);

  /// Takes the blobs that could be patches. Those twice too large become two halves as well.
  void load(std::span<const Blob> blobs, const Field& field);

  const std::vector<MetricBlob>& all() const { return sorted_; }
  /// Number of the frame's blobs, which the sources of `all` count.
  int source_count() const { return source_count_; }
  /// Whether the last frame held more blobs than are looked at.
  bool is_cut_short() const { return is_cut_short_; }
  /// Areas of anything that could be a patch, or two patches run into each other.
  double min_area_mm2() const { return min_area_mm2_; }
  double max_area_mm2() const { return max_area_mm2_; }
  /// Whether some id has the colour on some player patch.
  bool is_listed(Label label) const { return listed_[label]; }
  /// Indices [first, last) of the blobs with x within `reach_mm` of `x_mm`.
  std::pair<int, int> within_x(double x_mm, double reach_mm) const;

  bool is_team_color(Label label) const;
  /// Whether a robot with unlisted colours may show `label` on a player patch.
  bool may_be_player(Label label) const;
  /// Area within the limits for the patch.
  bool fits_area(const PatchModel& patch, const MetricBlob& blob) const;

 private:
  void add_halves(const MetricBlob& blob);
  void sort_by_position();

  const TrackingParameters& parameters_;
  std::span<const LayoutModel> layouts_;
  double min_area_mm2_ = 0.0;
  double max_area_mm2_ = 0.0;
  std::array<bool, 256> listed_{};
  std::vector<MetricBlob> blobs_;  ///< As they come.
  std::vector<int> order_;         ///< Of blobs_.
  std::vector<MetricBlob> sorted_;
  std::vector<double> xs_mm_;  ///< Of sorted_; near together, for within_x.
  int source_count_ = 0;
  bool is_cut_short_ = false;
};

/// Why a blob cannot be a certain player patch of the robot with a certain team patch.
enum class PatchRefusal {
  kNone,
  kOutOfReach,
  kTwoHalves,  ///< Both are halves of merged blobs.
  kColor,      ///< Listed for no id, and a team's or the ball's.
  kArea,
  kDistance,  ///< From the team patch.
};

/// Builds candidates from a team patch and at least one player patch.
class CandidateGenerator {
 public:
  CandidateGenerator(const TrackingParameters& parameters, std::span<const LayoutModel> layouts)
      : parameters_(parameters), layouts_(layouts) {}

  /// Appends to `candidates`.
  void generate(const TagBlobs& blobs, std::vector<Candidate>& candidates);

  /// Whether the last frame held so much noise that not everything was tried.
  bool is_cut_short() const { return is_cut_short_; }

  /// @param patch number of a player patch, from 1.
  PatchRefusal refusal(const TagBlobs& blobs, const LayoutModel& layout, const MetricBlob& team,
                       int patch, const MetricBlob& blob) const;
  /// How far, along x or y, a player patch can lie from its team patch.
  double reach_mm(const LayoutModel& layout) const;
  /// How far the distance of two patches may be off that of the pattern.
  double distance_tolerance_mm(const MetricBlob& a, const MetricBlob& b) const;

 private:
  /// A blob that may be a certain player patch of the robot being built.
  struct Option {
    int blob = 0;
    double cost = 0.0;
    double outline_cost = 0.0;
  };

  void list_options(const TagBlobs& blobs, const Candidate& start);
  /// A candidate being built, patch by patch.
  struct Partial {
    Candidate candidate;
    std::array<double, kMaxPatches> outline_costs{};  ///< Of the patches found.
  };
  void extend(const TagBlobs& blobs, Partial& partial, int patch,
              std::vector<Candidate>& candidates);
  bool keeps_distances(const TagBlobs& blobs, const Candidate& partial, int patch,
                       const MetricBlob& blob) const;
  bool keeps_distance(const LayoutModel& layout, int placed_patch, const MetricBlob& placed,
                      int patch, const MetricBlob& blob) const;
  bool finish(const TagBlobs& blobs, const Partial& partial, Candidate& candidate) const;
  bool read_colors(const TagBlobs& blobs, Candidate& candidate) const;
  bool fit(const TagBlobs& blobs, const Partial& partial, Candidate& candidate) const;

  const TrackingParameters& parameters_;
  std::span<const LayoutModel> layouts_;
  std::array<std::vector<Option>, kMaxPatches> options_;
  int tries_left_ = 0;
  bool is_cut_short_ = false;
};

}  // namespace maggic::tracking
