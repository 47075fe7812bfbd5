#pragma once
/// Tag patterns as data: which coloured patches a robot carries, where, and what they mean.

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/detections.hpp"
#include "maggic/parameters.hpp"

namespace maggic {

enum class PatchRole { kTeam, kPlayer };
enum class PatchShape { kRectangle, kDisc };

/// One coloured patch. Robot frame: mm, origin at the robot's centre, x to the front, y to the
/// left.
struct TagPatch {
  PatchRole role = PatchRole::kPlayer;
  PatchShape shape = PatchShape::kRectangle;
  cv::Point2d center_mm;
  /// Extent along x and y of the robot frame; for a disc both are its diameter. A patch that has
  /// a bite taken out (big square with a corner patch) gives `area_mm2` and the centroid instead.
  cv::Size2d size_mm;
  double area_mm2 = 0.0;  ///< 0: computed from shape and size.

  double expected_area_mm2() const;
  void describe(Parameters& parameters);
};

/// Player colours, in the order the player patches are listed, and the id they stand for.
struct TagId {
  int id = 0;
  std::vector<Label> colors;
};

/// One pattern: exactly one team patch and at least one player patch.
struct TagLayout {
  std::string name;
  std::vector<TagPatch> patches;
  std::vector<TagId> ids;
  /// Added to the heading the patches give, counter-clockwise.
  double heading_offset_deg = 0.0;

  /// Declares every part, checks that patches and ids fit each other, and rejects an id or a
  /// colour combination named twice.
  void describe(Parameters& parameters);
};

/// Two half-tags of 70 × 35 mm: team colour behind, player colour in front. Ids 0 … 4: red,
/// green, cyan, magenta, purple.
TagLayout two_tag_layout(const Palette& palette);

/// Team half of 70 × 35 mm behind, two 33 mm player squares in front. Player patches are listed
/// as seen with the team half on top: left, then right. Ids 0 … 9 as in the extended pattern: RG, RC, GR, GC, GM, CR, CG,
/// CM, MG, MC.
TagLayout three_tag_layout(const Palette& palette);

}  // namespace maggic
