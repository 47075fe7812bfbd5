#pragma once
/// A tag layout made ready for matching.

#include <array>
#include <cstdint>
#include <vector>

#include "maggic/tag_layout.hpp"

namespace maggic::tracking {

struct PatchModel {
  cv::Point2d center_mm;
  double area_mm2 = 0.0;
  double elongation = 1.0;    ///< Length over width, at least 1.
  double axis_rad = 0.0;      ///< Robot-frame direction of the longer side.
  double variance_mm2 = 0.0;  ///< Sum of the variances along both sides.

  /// Long enough to tell the heading's line from its second moments.
  bool is_elongated() const { return elongation > 1.4; }
};

/// Patches with the team's first; players keep the layout's order, which is the id table's.
struct LayoutModel {
  explicit LayoutModel(const TagLayout& layout);

  std::vector<PatchModel> patches;
  std::vector<TagId> ids;
  /// All patches as one blob: what is seen when the team's colour swallows the player's.
  PatchModel whole;
  double heading_offset_rad = 0.0;
  double half_extent_mm = 0.0;  ///< Half side of the square, round the centre, that holds the tag.
  double reach_mm = 0.0;        ///< Largest distance of a player patch from the team patch.
  /// A player patch may be missing from a robot that has several.
  int max_missing = 0;

  const PatchModel& team() const { return patches.front(); }
  int player_count() const { return static_cast<int>(patches.size()) - 1; }
  /// The id these colours stand for, kUnknownId when none. @param colors one a player patch.
  int find_id(const Label* colors) const;
  /// Whether some id has `color` on player patch `player` (from 0).
  bool is_listed(int player, Label color) const { return listed_players_[color] >> player & 1; }
  /// Between the centres of two patches.
  double distance_mm(int patch, int other) const {
    return distances_mm_[static_cast<std::size_t>(patch)][static_cast<std::size_t>(other)];
  }
  /// The colours of an id; null when this layout does not have it.
  const TagId* entry(int id) const;

 private:
  std::vector<Label> colors_;                       ///< Those of all ids, one id after the other.
  std::array<std::uint8_t, 256> listed_players_{};  ///< A bit a player patch.
  std::array<std::array<double, kMaxPatches>, kMaxPatches> distances_mm_{};
};

/// Centres of two robots with these tags are never nearer than this, measuring errors allowed for.
double min_separation_mm(const LayoutModel& a, const LayoutModel& b);

}  // namespace maggic::tracking
