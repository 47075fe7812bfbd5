#include "maggic/tag_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace maggic {
namespace {

// Nearer centres would leave the heading to the noise of the centroids.
constexpr double kMinPatchDistanceMm = 10.0;

std::string color_names(const std::vector<Label>& colors, const Palette& palette) {
  std::string names;
  for (const Label color : colors) {
    if (!names.empty()) names += ", ";
    names += palette.name(color);
  }
  return names;
}

void check_patches(Parameters& p, const std::vector<TagPatch>& patches) {
  const auto team_count = std::ranges::count(patches, PatchRole::kTeam, &TagPatch::role);
  p.check("patches", team_count == 1,
          fmt::format("{} patches have the role team, expected exactly one", team_count));
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const cv::Point2d apart = patches[i].center_mm - patches[k].center_mm;
      const double distance = std::hypot(apart.x, apart.y);
      p.check("patches", distance >= kMinPatchDistanceMm,
              fmt::format("the centres of patches {} and {} are {:.1f} mm apart, expected at least "
                          "{:.0f} mm",
                          k + 1, i + 1, distance, kMinPatchDistanceMm));
    }
  }
}

void check_ids(Parameters& p, const std::vector<TagId>& ids, std::size_t player_patches) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    p.check("ids", ids[i].colors.size() == player_patches,
            fmt::format("id {} names {} colours, expected {}: one for each player patch",
                        ids[i].id, ids[i].colors.size(), player_patches));
    for (std::size_t k = 0; k < i; ++k) {
      p.check("ids", ids[i].id != ids[k].id,
              fmt::format("id {} is listed twice, expected every id once", ids[i].id));
      p.check("ids", ids[i].colors != ids[k].colors,
              fmt::format("ids {} and {} have the same colours ({}), expected different ones",
                          ids[k].id, ids[i].id, color_names(ids[i].colors, p.palette())));
    }
  }
}

// Colours a palette does not hold cannot be seen, so the ids that need them are left out.
std::vector<TagId> id_table(const Palette& palette,
                            std::initializer_list<std::initializer_list<std::string_view>> rows) {
  std::vector<TagId> ids;
  int id = 0;
  for (const auto& row : rows) {
    TagId entry{id++, {}};
    for (const std::string_view name : row) {
      if (const std::optional<Label> label = palette.find(name)) entry.colors.push_back(*label);
    }
    if (entry.colors.size() == row.size()) ids.push_back(std::move(entry));
  }
  return ids;
}

TagPatch rectangle(PatchRole role, cv::Point2d center_mm, cv::Size2d size_mm) {
  return {role, PatchShape::kRectangle, center_mm, size_mm, 0.0};
}

}  // namespace

double TagPatch::expected_area_mm2() const {
  if (area_mm2 > 0.0) return area_mm2;
  const double box = size_mm.width * size_mm.height;
  return shape == PatchShape::kDisc ? box * std::numbers::pi / 4.0 : box;
}

void TagPatch::describe(Parameters& p) {
  p.choice<PatchRole>({"role", "whether the patch shows the team's or the player's colour", "",
                       Presence::kRequired},
                      role, {{"team", PatchRole::kTeam}, {"player", PatchRole::kPlayer}});
  p.choice<PatchShape>({"shape", "outline of the patch"}, shape,
                       {{"rectangle", PatchShape::kRectangle}, {"disc", PatchShape::kDisc}});
  p.point({"center_mm",
           "centroid of the patch from the robot's centre: x to the front, y to the left", "mm",
           Presence::kRequired},
          center_mm, {-200.0, 200.0});
  std::array<double, 2> extent{size_mm.width, size_mm.height};
  p.numbers({"size_mm", "extent along the robot's x and y; for a disc its diameter, twice", "mm",
             Presence::kRequired},
            extent, {5.0, 200.0});
  size_mm = {extent[0], extent[1]};
  p.number({"area_mm2", "area where a bite is taken out of the patch; 0: that of the outline",
            "mm²"},
           area_mm2, {0.0, 40000.0});
  p.check("size_mm", shape != PatchShape::kDisc || extent[0] == extent[1],
          fmt::format("a disc of {} × {} mm, expected its diameter twice", extent[0], extent[1]));
}

void TagLayout::describe(Parameters& p) {
  const Presence presence = patches.empty() ? Presence::kRequired : Presence::kOptional;
  p.text({"name", "what the pattern is called"}, name);
  p.list({"patches", "coloured patches on the robot: one of the team, the others of the player", "",
          presence},
         patches, {2, static_cast<int>(kMaxPatches)},
         [](Parameters& element, TagPatch& patch) { patch.describe(element); });
  // A missing or unreadable list has been reported as such; rules about it would only repeat that.
  if (!patches.empty()) check_patches(p, patches);
  describe_identity(p);
}

void TagLayout::describe_identity(Parameters& p) {
  const Presence presence = ids.empty() ? Presence::kRequired : Presence::kOptional;
  p.list({"ids", "which player colours stand for which id", "", presence}, ids, {1, 1000},
         [](Parameters& element, TagId& entry) {
           element.integer({"id", "number of the robot", "", Presence::kRequired}, entry.id,
                           {0, 999});
           element.list({"colors", "player colours in the order of the player patches", "",
                         Presence::kRequired},
                        entry.colors, {1, static_cast<int>(kMaxPatches) - 1},
                        [](Parameters& color, Label& label) {
                          color.color({"", "palette colour"}, label);
                        });
         });
  p.number({"heading_offset_deg", "added to the heading the patches give, counter-clockwise",
            "degrees"},
           heading_offset_deg, {-360.0, 360.0});
  if (!patches.empty()) check_ids(p, ids, patches.size() - 1);
}

TagLayout two_tag_layout(const Palette& palette, double side_mm) {
  const cv::Size2d half(side_mm / 2.0, side_mm);
  return {"two_tag",
          {rectangle(PatchRole::kTeam, {-side_mm / 4.0, 0.0}, half),
           rectangle(PatchRole::kPlayer, {side_mm / 4.0, 0.0}, half)},
          id_table(palette, {{"red"}, {"green"}, {"cyan"}, {"magenta"}, {"purple"}}),
          0.0};
}

TagLayout three_tag_layout(const Palette& palette, double side_mm, double square_mm) {
  const double quarter = side_mm / 4.0;
  const cv::Size2d square(square_mm, square_mm);
  // With the team half on top in the picture the robot faces down, so the left square in the
  // picture is on the robot's right.
  return {"three_tag",
          {rectangle(PatchRole::kTeam, {-quarter, 0.0}, {side_mm / 2.0, side_mm}),
           rectangle(PatchRole::kPlayer, {quarter, -quarter}, square),
           rectangle(PatchRole::kPlayer, {quarter, quarter}, square)},
          id_table(palette, {{"red", "green"},
                             {"red", "cyan"},
                             {"green", "red"},
                             {"green", "cyan"},
                             {"green", "magenta"},
                             {"cyan", "red"},
                             {"cyan", "green"},
                             {"cyan", "magenta"},
                             {"magenta", "green"},
                             {"magenta", "cyan"}}),
          0.0};
}

}  // namespace maggic
