#include "tracking/layout_model.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/angles.hpp"
#include "tracking/pose.hpp"

namespace maggic::tracking {
namespace {

PatchModel model_of(const TagPatch& patch) {
  PatchModel model;
  model.center_mm = patch.center_mm;
  model.area_mm2 = patch.expected_area_mm2();
  const double w = patch.size_mm.width;
  const double h = patch.size_mm.height;
  model.elongation = std::max(w, h) / std::min(w, h);
  model.axis_rad = h > w ? kPi / 2.0 : 0.0;
  const double side_divisor = patch.shape == PatchShape::kDisc ? 16.0 : 12.0;
  model.variance_mm2 = (w * w + h * h) / side_divisor;
  return model;
}

PatchModel union_of(const std::vector<TagPatch>& patches) {
  PatchModel whole;
  for (const TagPatch& patch : patches) {
    const double area = patch.expected_area_mm2();
    whole.area_mm2 += area;
    whole.center_mm += area * patch.center_mm;
  }
  whole.center_mm /= whole.area_mm2;
  cv::Point2d variance;
  double covariance = 0.0;
  for (const TagPatch& patch : patches) {
    const double weight = patch.expected_area_mm2() / whole.area_mm2;
    const double divisor = patch.shape == PatchShape::kDisc ? 16.0 : 12.0;
    const cv::Point2d off = patch.center_mm - whole.center_mm;
    variance.x += weight * (patch.size_mm.width * patch.size_mm.width / divisor + off.x * off.x);
    variance.y += weight * (patch.size_mm.height * patch.size_mm.height / divisor + off.y * off.y);
    covariance += weight * off.x * off.y;
  }
  const double mean = (variance.x + variance.y) / 2.0;
  const double half = std::hypot((variance.x - variance.y) / 2.0, covariance);
  whole.elongation = std::sqrt((mean + half) / std::max(mean - half, 1e-6));
  whole.axis_rad = 0.5 * std::atan2(2.0 * covariance, variance.x - variance.y);
  whole.variance_mm2 = 2.0 * mean;
  return whole;
}

}  // namespace

LayoutModel::LayoutModel(const TagLayout& layout)
    : ids(layout.ids),
      whole(union_of(layout.patches)),
      heading_offset_rad(radians(layout.heading_offset_deg)) {
  for (const PatchRole role : {PatchRole::kTeam, PatchRole::kPlayer}) {
    for (const TagPatch& patch : layout.patches) {
      if (patch.role != role) continue;
      patches.push_back(model_of(patch));
      half_extent_mm =
          std::max({half_extent_mm, std::abs(patch.center_mm.x) + patch.size_mm.width / 2.0,
                    std::abs(patch.center_mm.y) + patch.size_mm.height / 2.0});
      const cv::Point2d from_team = patch.center_mm - patches.front().center_mm;
      reach_mm = std::max(reach_mm, std::hypot(from_team.x, from_team.y));
    }
  }
  max_missing = player_count() / 2;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t k = 0; k < patches.size(); ++k) {
      distances_mm_[i][k] = length_of(patches[i].center_mm - patches[k].center_mm);
    }
  }
  for (const TagId& entry : ids) {
    colors_.insert(colors_.end(), entry.colors.begin(), entry.colors.end());
    for (std::size_t player = 0; player < entry.colors.size(); ++player) {
      listed_players_[entry.colors[player]] |= static_cast<std::uint8_t>(1u << player);
    }
  }
}

int LayoutModel::find_id(const Label* colors) const {
  auto listed = colors_.begin();
  for (const TagId& entry : ids) {
    const auto next = listed + player_count();
    if (std::equal(listed, next, colors)) return entry.id;
    listed = next;
  }
  return kUnknownId;
}

const TagId* LayoutModel::entry(int id) const {
  const auto found = std::ranges::find(ids, id, &TagId::id);
  return found == ids.end() ? nullptr : &*found;
}

double min_separation_mm(const LayoutModel& a, const LayoutModel& b) {
  return 0.75 * (a.half_extent_mm + b.half_extent_mm);
}

}  // namespace maggic::tracking
