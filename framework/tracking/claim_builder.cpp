#include "tracking/claim_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <boost/container/static_vector.hpp>

#include "tracking/fit_score.hpp"

namespace maggic::tracking {
namespace {

// A robot unseen for longer may have been replaced: its id is no longer held against colours.
constexpr int kHoldFrames = 5;
constexpr double kMaxHoldDistanceMm = 60.0;
// Sightings without the team patch, or of it alone, live on the prediction being good.
constexpr int kMaxBlindFrames = 8;
constexpr double kMaxBlindGateMm = 40.0;
constexpr double kBlindCost = 2.0;
constexpr int kSteadyFrames = 3;
constexpr double kMaxUnknownTeamCost = 4.0;
constexpr std::size_t kMaxClaims = 1000;
// A team blob of this part of the whole tag's area may have swallowed the player patches.
constexpr double kMinWholeRatio = 0.7;
constexpr double kMaxWholeRatio = 1.4;
// Squares below their limit by more than rounding are below it after the root as well.
constexpr double kRoundingSlack = 1.0 + 1e-9;

// Takes the heading from the line of one elongated blob, on the side nearest to the prediction.
void turn_to_line(const PatchModel& patch, const MetricBlob& blob, const RobotTrack& track,
                  Candidate& candidate) {
  double& heading = candidate.pose.heading_rad;
  heading = track.pose().heading_rad;
  candidate.heading_sigmas = 0.0;
  if (!patch.is_elongated() || blob.elongation() <= 1.4) return;
  heading += wrap_line(blob.axis_rad - patch.axis_rad - heading);
  candidate.heading_sigmas = 3.0;
}

}  // namespace

ClaimBuilder::ClaimBuilder(const TrackingParameters& parameters,
                           std::span<const LayoutModel> layouts)
    : parameters_(parameters), layouts_(layouts), place_conflicts_(layouts) {
  for (const LayoutModel& layout : layouts) {
    for (const TagId& entry : layout.ids) ids_.push_back(entry.id);
  }
  std::ranges::sort(ids_);
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
}

void ClaimBuilder::build(const TagBlobs& blobs, std::span<const RobotTrack> tracks,
                         cv::Point2d field_limit_mm, std::vector<Candidate>& candidates) {
  blobs_ = &blobs;
  tracks_ = tracks;
  field_limit_mm_ = field_limit_mm;
  candidates_ = &candidates;
  claims_.clear();
  contenders_.clear();
  expect_tracks();
  const int with_geometry = static_cast<int>(candidates.size());
  for (int c = 0; c < with_geometry; ++c) {
    find_near(candidates[static_cast<std::size_t>(c)]);
    claim_by_colors(c);
    claim_by_motion(c);
    claim_as_unknown(c);
  }
  for (int t = 0; t < static_cast<int>(tracks.size()); ++t) {
    claim_team_patch_of(t);
    claim_player_patches_of(t);
  }
  if (parameters_.report_unknown) {
    for (int b = 0; b < static_cast<int>(blobs.all().size()); ++b) claim_team_patch_alone(b);
  }
  keep_best();
  conflicts_ = place_conflicts_.find(blobs, candidates, contenders_);
}

ClaimBuilder::Expectation ClaimBuilder::expectation_of(int t) const {
  const RobotTrack& track = tracks_[static_cast<std::size_t>(t)];
  const double gate_mm = track.gate_mm(parameters_);
  // As long as the heading is unknown the place may be off by as much as the team patch is.
  const double slack_mm =
      track.heading_known ? 0.0 : length_of(layout_at(track.layout).team().center_mm);
  const double reach_mm = gate_mm + slack_mm;
  return {.position_mm = track.pose().position_mm,
          .reach_mm = reach_mm,
          .squared_reach_mm2 = reach_mm * reach_mm * kRoundingSlack,
          .near_width_mm = std::max(6.0, gate_mm / 2.5),
          .heading_rad = track.pose().heading_rad,
          .heading_known = track.heading_known,
          .team = track.team,
          .id = track.id,
          .track = t};
}

void ClaimBuilder::expect_tracks() {
  for (std::vector<Expectation>& team : expected_) team.clear();
  for (int t = 0; t < static_cast<int>(tracks_.size()); ++t) {
    const Expectation expected = expectation_of(t);
    expected_[static_cast<std::size_t>(expected.team)].push_back(expected);
  }
}

void ClaimBuilder::find_near(const Candidate& candidate) {
  near_.clear();
  for (const Expectation& expected : expected_[static_cast<std::size_t>(candidate.team)]) {
    const cv::Point2d off = candidate.pose.position_mm - expected.position_mm;
    const double squared = off.dot(off);
    if (squared > expected.squared_reach_mm2) continue;
    const double distance_mm = std::sqrt(squared);
    if (distance_mm <= expected.reach_mm) near_.push_back({&expected, distance_mm});
  }
}

int ClaimBuilder::identity_of(Team team, int id, int track) const {
  if (id >= 0) {
    const auto rank = std::ranges::lower_bound(ids_, id) - ids_.begin();
    return 2 * static_cast<int>(rank) + static_cast<int>(team);
  }
  return track >= 0 ? 2 * static_cast<int>(ids_.size()) + track : -1;
}

// Pairs of claims exclude each other, so that their number has to have an end.
void ClaimBuilder::keep_best() {
  is_cut_short_ = claims_.size() > kMaxClaims;
  if (!is_cut_short_) return;
  by_score_.resize(claims_.size());
  std::iota(by_score_.begin(), by_score_.end(), 0);
  const auto score_of = [&](int claim) {
    return contenders_[static_cast<std::size_t>(claim)].score;
  };
  std::ranges::nth_element(by_score_, by_score_.begin() + kMaxClaims, [&](int a, int b) {
    return score_of(a) != score_of(b) ? score_of(a) > score_of(b) : a < b;
  });
  by_score_.resize(kMaxClaims);
  std::ranges::sort(by_score_);
  for (std::size_t i = 0; i < kMaxClaims; ++i) {
    const auto from = static_cast<std::size_t>(by_score_[i]);
    claims_[i] = claims_[from];
    contenders_[i] = contenders_[from];
  }
  claims_.resize(kMaxClaims);
  contenders_.resize(kMaxClaims);
}

void ClaimBuilder::add(int candidate, int id, int track, double score) {
  if (score <= 0.0) return;
  const Candidate& sighting = (*candidates_)[static_cast<std::size_t>(candidate)];
  const int team_blob = sighting.blobs[0];
  claims_.push_back({candidate, id, track});
  // At most one claim on a team patch holds, and at most one on a track that lacks its own.
  const int group = team_blob >= 0 ? team_blob : static_cast<int>(blobs_->all().size()) + track;
  contenders_.push_back({score, group, candidate, identity_of(sighting.team, id, track)});
}

void ClaimBuilder::claim_by_colors(int index) {
  const Candidate& candidate = (*candidates_)[static_cast<std::size_t>(index)];
  if (candidate.color_id == kUnknownId) return;
  double score = candidate.score + kListedScore;
  int own = -1;
  bool contrary = false;
  for (const auto& [expected, distance_mm] : near_) {
    if (expected->id == candidate.color_id) {
      own = expected->track;
      score += near_score(*expected, distance_mm, candidate);
      continue;
    }
    const RobotTrack& track = tracks_[static_cast<std::size_t>(expected->track)];
    if (track.seen_frames >= kSteadyFrames && track.missed_frames < kHoldFrames &&
        distance_mm < kMaxHoldDistanceMm && !track.is_refuted_by(candidate.color_id)) {
      contrary = true;
    }
  }
  if (own < 0 && contrary) score -= kContraryCost;
  add(index, candidate.color_id, own, score);
}

void ClaimBuilder::claim_by_motion(int index) {
  const Candidate& candidate = (*candidates_)[static_cast<std::size_t>(index)];
  for (const auto& [expected, distance_mm] : near_) {
    const RobotTrack& track = tracks_[static_cast<std::size_t>(expected->track)];
    const bool colors_say_so = candidate.complete && track.id == candidate.color_id;
    if (colors_say_so && track.id != kUnknownId) continue;
    if (track.missed_frames >= kHoldFrames || distance_mm > kMaxHoldDistanceMm) continue;
    double score = candidate.score + near_score(*expected, distance_mm, candidate);
    if (track.id == kUnknownId) {
      score -= kUnlistedCost;
    } else if (!shows_colors_of(track, candidate)) {
      score -= kHeldCost;
    }
    if (track.layout != candidate.layout) score -= kHeldCost;
    if (candidate.complete && !colors_say_so && track.is_refuted_by(candidate.color_id)) {
      score -= kContraryCost;
    }
    add(index, track.id, expected->track, score);
  }
}

UnknownRefusal ClaimBuilder::refusal_as_unknown(const Candidate& candidate) const {
  if (!parameters_.report_unknown) return UnknownRefusal::kNotReported;
  if (candidate.has_half) return UnknownRefusal::kHalf;
  if (std::abs(candidate.pose.position_mm.x) > field_limit_mm_.x ||
      std::abs(candidate.pose.position_mm.y) > field_limit_mm_.y) {
    return UnknownRefusal::kOutside;
  }
  return candidate.team_cost > kMaxUnknownTeamCost ? UnknownRefusal::kShape : UnknownRefusal::kNone;
}

void ClaimBuilder::claim_as_unknown(int index) {
  const Candidate& candidate = (*candidates_)[static_cast<std::size_t>(index)];
  if (refusal_as_unknown(candidate) != UnknownRefusal::kNone) return;
  add(index, kUnknownId, -1, candidate.score - kUnlistedCost);
}

void ClaimBuilder::claim_team_patch_alone(int b) {
  const MetricBlob& blob = blob_at(b);
  if (!blobs_->is_team_color(blob.label) || std::abs(blob.position_mm.x) > field_limit_mm_.x ||
      std::abs(blob.position_mm.y) > field_limit_mm_.y) {
    return;
  }
  for (int l = 0; l < static_cast<int>(layouts_.size()); ++l) {
    const PatchModel& patch = layout_at(l).team();
    if (!blobs_->fits_area(patch, blob) || !is_convincing_alone(patch, blob)) continue;
    Candidate candidate;
    candidate.team = blob.label == parameters_.blue_team_color ? Team::kBlue : Team::kYellow;
    candidate.layout = l;
    candidate.blobs[0] = b;
    candidate.found = 1;
    candidate.heading_known = false;
    // Front and back look alike: the robot is as likely on one side of the patch as on the other.
    candidate.pose.position_mm = blob.position_mm;
    if (patch.is_elongated()) {
      candidate.pose.heading_rad = wrap_line(blob.axis_rad - patch.axis_rad);
      candidate.heading_sigmas = 4.0;
    } else {
      candidate.heading_sigmas = 0.0;
    }
    candidate.position_sigmas = 2.0;
    candidate.team_cost = outline_cost(patch, blob);
    candidate.score = kPatchScore - candidate.team_cost;
    candidates_->push_back(candidate);
    add(static_cast<int>(candidates_->size()) - 1, kUnknownId, -1,
        candidate.score - kUnlistedCost - kBlindCost);
    return;
  }
}

void ClaimBuilder::claim_team_patch_of(int t) {
  const RobotTrack& track = tracks_[static_cast<std::size_t>(t)];
  if (track.missed_frames >= kMaxBlindFrames) return;
  const LayoutModel& layout = layout_at(track.layout);
  claim_team_blobs_of(t, layout.team(), parameters_.patch_min_area_ratio,
                      parameters_.patch_max_area_ratio, 0.0);
  claim_team_blobs_of(t, layout.whole, kMinWholeRatio, kMaxWholeRatio, kBlindCost);
}

void ClaimBuilder::claim_team_blobs_of(int t, const PatchModel& patch, double min_ratio,
                                       double max_ratio, double cost) {
  const RobotTrack& track = tracks_[static_cast<std::size_t>(t)];
  const Label label =
      track.team == Team::kBlue ? parameters_.blue_team_color : parameters_.yellow_team_color;
  const cv::Point2d offset_mm = track.heading_known ? patch.center_mm : cv::Point2d();
  const cv::Point2d expected = track.pose().apply(offset_mm);
  const double gate = std::min(track.gate_mm(parameters_), kMaxBlindGateMm);
  const auto [first, last] = blobs_->within_x(expected.x, gate);
  for (int b = first; b < last; ++b) {
    const MetricBlob& blob = blob_at(b);
    const double ratio = blob.area_mm2 / patch.area_mm2;
    if (blob.label != label || blob.is_half() || ratio < min_ratio || ratio > max_ratio ||
        length_of(blob.position_mm - expected) > gate) {
      continue;
    }
    Candidate candidate;
    candidate.team = track.team;
    candidate.layout = track.layout;
    candidate.blobs[0] = b;
    candidate.found = 1;
    candidate.heading_known = track.heading_known;
    // One blob shows a line; the side of it the robot faces is the one it faced before.
    turn_to_line(patch, blob, track, candidate);
    candidate.pose.position_mm = blob.position_mm;
    candidate.pose.position_mm -= candidate.pose.apply(offset_mm) - blob.position_mm;
    candidate.position_sigmas = 2.0;
    candidate.team_cost =
        outline_cost(patch, blob) + direction_cost(patch, blob, candidate.pose.heading_rad);
    candidate.score = kPatchScore - cost - candidate.team_cost;
    candidates_->push_back(candidate);
    add(static_cast<int>(candidates_->size()) - 1, track.id, t,
        candidate.score + near_score(t, candidate));
  }
}

void ClaimBuilder::claim_player_patches_of(int t) {
  const RobotTrack& track = tracks_[static_cast<std::size_t>(t)];
  const LayoutModel& layout = layout_at(track.layout);
  const TagId* entry = layout.entry(track.id);
  if (!entry || !track.heading_known || track.missed_frames >= kMaxBlindFrames) return;
  const double gate = std::min(track.gate_mm(parameters_), kMaxBlindGateMm);
  Candidate candidate;
  boost::container::static_vector<PointPair, kMaxPatches> pairs;
  std::size_t seen_patch = 0;
  for (std::size_t k = 1; k < layout.patches.size(); ++k) {
    const cv::Point2d expected = track.pose().apply(layout.patches[k].center_mm);
    const auto [first, last] = blobs_->within_x(expected.x, gate);
    double nearest = gate;
    for (int b = first; b < last; ++b) {
      const MetricBlob& blob = blob_at(b);
      const cv::Point2d off = blob.position_mm - expected;
      const double distance = length_of(off);
      const auto& taken = candidate.blobs;
      if (blob.label != entry->colors[k - 1] || blob.is_half() || distance > nearest ||
          !blobs_->fits_area(layout.patches[k], blob) ||
          std::find(taken.begin(), taken.end(), b) != taken.end()) {
        continue;
      }
      nearest = distance;
      candidate.blobs[k] = b;
    }
    if (candidate.blobs[k] < 0) continue;
    pairs.push_back({layout.patches[k].center_mm, blob_at(candidate.blobs[k]).position_mm, 1.0});
    seen_patch = k;
  }
  if (pairs.empty()) return;

  candidate.team = track.team;
  candidate.layout = track.layout;
  candidate.found = static_cast<int>(pairs.size());
  candidate.position_sigmas = 2.0;
  if (pairs.size() > 1) {
    candidate.pose = fit_pose({pairs.data(), pairs.size()});
    candidate.heading_sigmas = 2.0;
  } else {
    const PatchModel& patch = layout.patches[seen_patch];
    const MetricBlob& blob = blob_at(candidate.blobs[seen_patch]);
    turn_to_line(patch, blob, track, candidate);
    candidate.pose.position_mm = blob.position_mm - candidate.pose.apply(patch.center_mm);
  }
  for (std::size_t k = 1; k < layout.patches.size(); ++k) {
    if (candidate.blobs[k] < 0) continue;
    const MetricBlob& blob = blob_at(candidate.blobs[k]);
    const cv::Point2d off = blob.position_mm - candidate.pose.apply(layout.patches[k].center_mm);
    candidate.score += kPatchScore -
                       (outline_cost(layout.patches[k], blob) +
                        direction_cost(layout.patches[k], blob, candidate.pose.heading_rad)) -
                       place_cost(length_of(off), parameters_.max_patch_error_mm);
  }
  candidates_->push_back(candidate);
  add(static_cast<int>(candidates_->size()) - 1, track.id, t,
      candidate.score - kBlindCost + near_score(t, candidate));
}

double ClaimBuilder::near_score(const Expectation& expected, double distance_mm,
                                const Candidate& candidate) const {
  const double off = distance_mm / expected.near_width_mm;
  double score = kNearPlaceScore * std::exp(-0.5 * off * off);
  if (expected.heading_known && candidate.heading_known) {
    const double turned =
        wrap_turn(candidate.pose.heading_rad - expected.heading_rad) / radians(20.0);
    score += kNearHeadingScore * std::exp(-0.5 * turned * turned);
  }
  return score;
}

double ClaimBuilder::near_score(int track, const Candidate& candidate) const {
  const Expectation expected = expectation_of(track);
  return near_score(expected, length_of(candidate.pose.position_mm - expected.position_mm),
                    candidate);
}

bool ClaimBuilder::shows_colors_of(const RobotTrack& track, const Candidate& candidate) const {
  const TagId* entry = layout_at(candidate.layout).entry(track.id);
  if (!entry) return false;
  for (std::size_t k = 0; k < entry->colors.size(); ++k) {
    const int blob = candidate.blobs[k + 1];
    if (blob >= 0 && blob_at(blob).label != entry->colors[k]) return false;
  }
  return true;
}

bool ClaimBuilder::exclude_each_other(int claim, int other) const {
  const Contender& a = contenders_[static_cast<std::size_t>(claim)];
  const Contender& b = contenders_[static_cast<std::size_t>(other)];
  if (a.group == b.group || (a.identity >= 0 && a.identity == b.identity)) return true;
  return std::ranges::any_of(conflicts_, [&](const std::pair<int, int>& pair) {
    return pair == std::pair(a.place, b.place) || pair == std::pair(b.place, a.place);
  });
}

}  // namespace maggic::tracking
