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
  cv::Size2d size_mm{35.0, 35.0};
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
  /// Declares and checks `ids` and `heading_offset_deg` alone, for trackers of a fixed pattern.
  void describe_identity(Parameters& parameters);
};

/// Two half-tags that make a square of `side_mm`: team colour behind, player colour in front.
/// Ids 0 … 4: red, green, cyan, magenta, purple; those whose colours the palette lacks are left
/// out.
TagLayout two_tag_layout(const Palette& palette, double side_mm = 70.0);

/// Team half of a square of `side_mm` behind, two player squares of `square_mm` in front. Player
/// patches are listed as seen with the team half on top: left, then right. Ids 0 … 9 as in the
/// extended pattern: RG, RC, GR, GC, GM, CR, CG, CM, MG, MC.
TagLayout three_tag_layout(const Palette& palette, double side_mm = 70.0, double square_mm = 33.0);

}  // namespace maggic
