#include "tracking/candidate_generator.hpp"

#include <algorithm>
#include <cmath>

#include <boost/container/static_vector.hpp>

#include "tracking/angles.hpp"
#include "tracking/fit_score.hpp"

namespace maggic::tracking {
namespace {

// More readings than these of one team patch, or of a frame, only come up in noise.
constexpr int kMaxPerTeamBlob = 24;
constexpr int kMaxPerFrame = 3000;
// Blobs tried as patches, in a frame of noise shared out evenly among the team patches.
constexpr int kMaxTriesPerTeamBlob = 20'000;
constexpr int kMaxTriesPerFrame = 500'000;

bool is_worth_more(const Candidate& x, const Candidate& y) {
  const auto worth = [](const Candidate& c) {
    return c.score + (c.color_id != kUnknownId ? kListedScore : 0.0);
  };
  if (worth(x) != worth(y)) return worth(x) > worth(y);
  return x.layout != y.layout ? x.layout < y.layout : x.blobs < y.blobs;
}

// Where the halves of a merged blob part is known roughly only; the other patch's own direction is
// better than the line between the two.
void turn_to_whole_patch(const PatchModel& patch, const MetricBlob& blob, Pose& pose) {
  if (!patch.is_elongated()) return;
  pose.heading_rad += wrap_line(blob.axis_rad - patch.axis_rad - pose.heading_rad);
  pose.heading_rad = wrap_turn(pose.heading_rad);
  pose.position_mm += blob.position_mm - pose.apply(patch.center_mm);
}

}  // namespace

void CandidateGenerator::generate(const TagBlobs& blobs, std::vector<Candidate>& candidates) {
  const std::vector<MetricBlob>& all = blobs.all();
  is_cut_short_ = false;
  const int team_blobs = static_cast<int>(std::ranges::count_if(
      all, [&](const MetricBlob& blob) { return blobs.is_team_color(blob.label); }));
  if (team_blobs == 0) return;
  const auto most =
      static_cast<std::ptrdiff_t>(std::clamp(kMaxPerFrame / team_blobs, 4, kMaxPerTeamBlob));
  const int tries = std::min(kMaxTriesPerFrame / team_blobs, kMaxTriesPerTeamBlob);
  for (int b = 0; b < static_cast<int>(all.size()); ++b) {
    const MetricBlob& blob = all[static_cast<std::size_t>(b)];
    if (!blobs.is_team_color(blob.label)) continue;
    tries_left_ = tries;
    const auto first = static_cast<std::ptrdiff_t>(candidates.size());
    for (int l = 0; l < static_cast<int>(layouts_.size()); ++l) {
      const LayoutModel& layout = layouts_[static_cast<std::size_t>(l)];
      if (!blobs.fits_area(layout.team(), blob)) continue;
      Partial start;
      start.candidate.team =
          blob.label == parameters_.blue_team_color ? Team::kBlue : Team::kYellow;
      start.candidate.layout = l;
      start.candidate.blobs[0] = b;
      start.candidate.found = 1;
      start.candidate.has_half = blob.is_half();
      list_options(blobs, start.candidate);
      start.outline_costs[0] = outline_cost(layout.team(), blob);
      extend(blobs, start, 1, candidates);
    }
    is_cut_short_ = is_cut_short_ || tries_left_ <= 0;
    if (static_cast<std::ptrdiff_t>(candidates.size()) - first > most) {
      std::sort(candidates.begin() + first, candidates.end(), is_worth_more);
      candidates.resize(static_cast<std::size_t>(first + most));
    }
  }
}

void CandidateGenerator::list_options(const TagBlobs& blobs, const Candidate& start) {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(start.layout)];
  const MetricBlob& team = blobs.all()[static_cast<std::size_t>(start.blobs[0])];
  const double reach = reach_mm(layout);
  const auto [first, last] = blobs.within_x(team.position_mm.x, reach);
  for (std::vector<Option>& options : options_) options.clear();
  for (int b = first; b < last; ++b) {
    const MetricBlob& blob = blobs.all()[static_cast<std::size_t>(b)];
    if (std::abs(blob.position_mm.y - team.position_mm.y) > reach) continue;
    for (int patch = 1; patch <= layout.player_count(); ++patch) {
      if (refusal(blobs, layout, team, patch, blob) != PatchRefusal::kNone) continue;
      const PatchModel& model = layout.patches[static_cast<std::size_t>(patch)];
      const double off =
          length_of(blob.position_mm - team.position_mm) - layout.distance_mm(0, patch);
      const double outline = outline_cost(model, blob);
      options_[static_cast<std::size_t>(patch)].push_back(
          {b,
           place_cost(off, parameters_.max_patch_error_mm) + outline +
               (layout.is_listed(patch - 1, blob.label) ? 0.0 : kUnlistedCost),
           outline});
    }
  }
  // Best first: when there is too much to try, what is left out is the least likely.
  for (std::vector<Option>& options : options_) {
    std::ranges::sort(options, [](const Option& a, const Option& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.blob < b.blob;
    });
  }
}

double CandidateGenerator::reach_mm(const LayoutModel& layout) const {
  return layout.reach_mm + 3.0 * parameters_.max_patch_error_mm;
}

PatchRefusal CandidateGenerator::refusal(const TagBlobs& blobs, const LayoutModel& layout,
                                         const MetricBlob& team, int patch,
                                         const MetricBlob& blob) const {
  const double reach = reach_mm(layout);
  if (std::abs(blob.position_mm.x - team.position_mm.x) > reach ||
      std::abs(blob.position_mm.y - team.position_mm.y) > reach) {
    return PatchRefusal::kOutOfReach;
  }
  if (blob.is_half() && team.is_half()) return PatchRefusal::kTwoHalves;
  const bool may_be_unlisted = !blobs.is_team_color(blob.label) &&
                               blobs.may_be_player(blob.label) &&
                               blob.label != parameters_.ball_color;
  if (!may_be_unlisted && !layout.is_listed(patch - 1, blob.label)) return PatchRefusal::kColor;
  if (!blobs.fits_area(layout.patches[static_cast<std::size_t>(patch)], blob)) {
    return PatchRefusal::kArea;
  }
  return keeps_distance(layout, 0, team, patch, blob) ? PatchRefusal::kNone
                                                      : PatchRefusal::kDistance;
}

void CandidateGenerator::extend(const TagBlobs& blobs, Partial& partial, int patch,
                                std::vector<Candidate>& candidates) {
  Candidate& built = partial.candidate;
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(built.layout)];
  if (patch > layout.player_count()) {
    Candidate candidate = built;
    if (built.found > 1 && finish(blobs, partial, candidate)) candidates.push_back(candidate);
    return;
  }
  for (const Option& option : options_[static_cast<std::size_t>(patch)]) {
    if (--tries_left_ <= 0) return;
    const MetricBlob& blob = blobs.all()[static_cast<std::size_t>(option.blob)];
    if (blob.is_half() && built.has_half) continue;
    if (!keeps_distances(blobs, built, patch, blob)) continue;
    built.blobs[static_cast<std::size_t>(patch)] = option.blob;
    partial.outline_costs[static_cast<std::size_t>(patch)] = option.outline_cost;
    ++built.found;
    built.has_half = built.has_half || blob.is_half();
    extend(blobs, partial, patch + 1, candidates);
    built.blobs[static_cast<std::size_t>(patch)] = -1;
    --built.found;
    if (blob.is_half()) built.has_half = false;
  }
  if (patch - built.found < layout.max_missing) extend(blobs, partial, patch + 1, candidates);
}

bool CandidateGenerator::keeps_distances(const TagBlobs& blobs, const Candidate& partial, int patch,
                                         const MetricBlob& blob) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(partial.layout)];
  // The distance from the team patch, number 0, has been looked at once and for all.
  for (int k = 1; k < patch; ++k) {
    const int other = partial.blobs[static_cast<std::size_t>(k)];
    if (other < 0) continue;
    const MetricBlob& placed = blobs.all()[static_cast<std::size_t>(other)];
    if (!keeps_distance(layout, k, placed, patch, blob)) return false;
  }
  return true;
}

bool CandidateGenerator::keeps_distance(const LayoutModel& layout, int placed_patch,
                                        const MetricBlob& placed, int patch,
                                        const MetricBlob& blob) const {
  if (placed.source == blob.source && (placed.parts & blob.parts) != 0) return false;
  return std::abs(length_of(placed.position_mm - blob.position_mm) -
                  layout.distance_mm(placed_patch, patch)) <= distance_tolerance_mm(placed, blob);
}

double CandidateGenerator::distance_tolerance_mm(const MetricBlob& a, const MetricBlob& b) const {
  return (a.is_half() || b.is_half() ? 3.0 : 2.0) * parameters_.max_patch_error_mm;
}

bool CandidateGenerator::finish(const TagBlobs& blobs, const Partial& partial,
                                Candidate& candidate) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(candidate.layout)];
  candidate.complete = candidate.found == layout.player_count() + 1;
  return read_colors(blobs, candidate) && fit(blobs, partial, candidate);
}

bool CandidateGenerator::read_colors(const TagBlobs& blobs, Candidate& candidate) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(candidate.layout)];
  if (candidate.complete) {
    std::array<Label, kMaxPatches> colors{};
    for (int k = 0; k < layout.player_count(); ++k) {
      const int blob = candidate.blobs[static_cast<std::size_t>(k) + 1];
      colors[static_cast<std::size_t>(k)] = blobs.all()[static_cast<std::size_t>(blob)].label;
    }
    candidate.color_id = layout.find_id(colors.data());
  }
  // Half a blob is worth a robot only when everything else is beyond doubt.
  return !candidate.has_half || candidate.color_id != kUnknownId;
}

bool CandidateGenerator::fit(const TagBlobs& blobs, const Partial& partial,
                             Candidate& candidate) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(candidate.layout)];
  const auto blob_of = [&](std::size_t patch) {
    return &blobs.all()[static_cast<std::size_t>(candidate.blobs[patch])];
  };
  boost::container::static_vector<PointPair, kMaxPatches> pairs;
  std::size_t whole = 0;
  for (std::size_t k = 0; k < layout.patches.size(); ++k) {
    if (candidate.blobs[k] < 0) continue;
    const bool half = blob_of(k)->is_half();
    pairs.push_back({layout.patches[k].center_mm, blob_of(k)->position_mm, half ? 0.05 : 1.0});
    if (!half) whole = k;
  }
  Placement placement = fit_placement({pairs.data(), pairs.size()});
  if (candidate.has_half && pairs.size() == 2) {
    Pose turned = placement.pose();
    turn_to_whole_patch(layout.patches[whole], *blob_of(whole), turned);
    placement = Placement(turned);
  }
  candidate.pose = placement.pose();
  const double max_error = (candidate.has_half ? 2.0 : 1.0) * parameters_.max_patch_error_mm;
  candidate.score = 0.0;
  for (std::size_t k = 0; k < layout.patches.size(); ++k) {
    if (candidate.blobs[k] < 0) {
      candidate.score -= kMissingPatchCost;
      continue;
    }
    const MetricBlob& blob = *blob_of(k);
    const cv::Point2d off = blob.position_mm - placement.apply(layout.patches[k].center_mm);
    const double error = length_of(off);
    if (error > max_error) return false;
    candidate.score += blob.is_half() ? kHalfPatchScore : kPatchScore;
    candidate.score -= place_cost(error, max_error);
    const double cost = partial.outline_costs[k] +
                        direction_cost(layout.patches[k], blob, candidate.pose.heading_rad);
    if (k == 0) candidate.team_cost = cost;
    candidate.score -= cost;
  }
  const double sigmas = candidate.has_half ? 4.0 : candidate.complete ? 1.0 : 1.5;
  candidate.position_sigmas = sigmas;
  candidate.heading_sigmas = sigmas;
  return true;
}

}  // namespace maggic::tracking
