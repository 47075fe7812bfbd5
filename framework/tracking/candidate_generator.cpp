#include "tracking/candidate_generator.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <boost/container/static_vector.hpp>

#include "tracking/angles.hpp"
#include "tracking/fit_score.hpp"

namespace maggic::tracking {
namespace {

// More readings than these of one team patch only come up in noise.
constexpr std::size_t kMaxPerTeamBlob = 24;

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
  for (int b = 0; b < static_cast<int>(all.size()); ++b) {
    const MetricBlob& blob = all[static_cast<std::size_t>(b)];
    if (!blobs.is_team_color(blob.label)) continue;
    const std::size_t first = candidates.size();
    for (int l = 0; l < static_cast<int>(layouts_.size()); ++l) {
      const LayoutModel& layout = layouts_[static_cast<std::size_t>(l)];
      if (!blobs.fits_area(layout.team(), blob)) continue;
      const double reach = layout.reach_mm + 2.0 * parameters_.max_patch_error_mm;
      std::tie(first_near_, last_near_) = blobs.within_x(blob.position_mm.x, reach);
      Candidate start;
      start.team = blob.label == parameters_.blue_team_color ? Team::kBlue : Team::kYellow;
      start.layout = l;
      start.blobs[0] = b;
      start.found = 1;
      start.has_half = blob.is_half();
      extend(blobs, start, 1, candidates);
    }
    if (candidates.size() - first > kMaxPerTeamBlob) {
      std::sort(candidates.begin() + static_cast<std::ptrdiff_t>(first), candidates.end(),
                [](const Candidate& x, const Candidate& y) {
                  const auto worth = [](const Candidate& c) {
                    return c.score + (c.color_id != kUnknownId ? kListedScore : 0.0);
                  };
                  if (worth(x) != worth(y)) return worth(x) > worth(y);
                  return x.layout != y.layout ? x.layout < y.layout : x.blobs < y.blobs;
                });
      candidates.resize(first + kMaxPerTeamBlob);
    }
  }
}

void CandidateGenerator::extend(const TagBlobs& blobs, Candidate& partial, int patch,
                                std::vector<Candidate>& candidates) {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(partial.layout)];
  if (patch > layout.player_count()) {
    Candidate candidate = partial;
    if (partial.found > 1 && finish(blobs, candidate)) candidates.push_back(candidate);
    return;
  }
  const PatchModel& model = layout.patches[static_cast<std::size_t>(patch)];
  for (int b = first_near_; b < last_near_; ++b) {
    const MetricBlob& blob = blobs.all()[static_cast<std::size_t>(b)];
    if (blob.is_half() && partial.has_half) continue;
    if (!blobs.fits_area(model, blob) || !keeps_distances(blobs, partial, patch, blob)) continue;
    if (!layout.is_listed(patch - 1, blob.label) &&
        (blobs.is_team_color(blob.label) || !blobs.may_be_player(blob.label) ||
         blob.label == parameters_.ball_color)) {
      continue;
    }
    partial.blobs[static_cast<std::size_t>(patch)] = b;
    ++partial.found;
    partial.has_half = partial.has_half || blob.is_half();
    extend(blobs, partial, patch + 1, candidates);
    partial.blobs[static_cast<std::size_t>(patch)] = -1;
    --partial.found;
    if (blob.is_half()) partial.has_half = false;
  }
  if (patch - partial.found < layout.max_missing) extend(blobs, partial, patch + 1, candidates);
}

bool CandidateGenerator::keeps_distances(const TagBlobs& blobs, const Candidate& partial,
                                         int patch, const MetricBlob& blob) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(partial.layout)];
  const cv::Point2d center = layout.patches[static_cast<std::size_t>(patch)].center_mm;
  for (int k = 0; k < patch; ++k) {
    const int other = partial.blobs[static_cast<std::size_t>(k)];
    if (other < 0) continue;
    const MetricBlob& placed = blobs.all()[static_cast<std::size_t>(other)];
    if (placed.source == blob.source && (placed.parts & blob.parts) != 0) return false;
    const cv::Point2d expected = layout.patches[static_cast<std::size_t>(k)].center_mm - center;
    const cv::Point2d seen = placed.position_mm - blob.position_mm;
    const double tolerance =
        (placed.is_half() || blob.is_half() ? 3.0 : 2.0) * parameters_.max_patch_error_mm;
    if (std::abs(std::sqrt(seen.dot(seen)) - std::sqrt(expected.dot(expected))) > tolerance) {
      return false;
    }
  }
  return true;
}

bool CandidateGenerator::finish(const TagBlobs& blobs, Candidate& candidate) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(candidate.layout)];
  candidate.complete = candidate.found == layout.player_count() + 1;
  return read_colors(blobs, candidate) && fit(blobs, candidate);
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

bool CandidateGenerator::fit(const TagBlobs& blobs, Candidate& candidate) const {
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
  candidate.pose = fit_pose({pairs.data(), pairs.size()});
  if (candidate.has_half && pairs.size() == 2) {
    turn_to_whole_patch(layout.patches[whole], *blob_of(whole), candidate.pose);
  }
  const double max_error = (candidate.has_half ? 2.0 : 1.0) * parameters_.max_patch_error_mm;
  candidate.score = 0.0;
  for (std::size_t k = 0; k < layout.patches.size(); ++k) {
    if (candidate.blobs[k] < 0) {
      candidate.score -= kMissingPatchCost;
      continue;
    }
    const MetricBlob& blob = *blob_of(k);
    const cv::Point2d off =
        blob.position_mm - candidate.pose.apply(layout.patches[k].center_mm);
    const double error = std::hypot(off.x, off.y);
    if (error > max_error) return false;
    candidate.score += blob.is_half() ? kHalfPatchScore : kPatchScore;
    candidate.score -= place_cost(error, max_error);
    candidate.score -= shape_cost(layout.patches[k], blob, &candidate.pose.heading_rad);
  }
  const double sigmas = candidate.has_half ? 4.0 : candidate.complete ? 1.0 : 1.5;
  candidate.position_sigmas = sigmas;
  candidate.heading_sigmas = sigmas;
  return true;
}

}  // namespace maggic::tracking
