#include "tracking/robot_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "core/fill_with_room.hpp"
#include "tracking/fit_score.hpp"

namespace maggic::tracking {
namespace {

// Goals and corners lie outside the length × width rectangle; a robot can be there.
constexpr double kFieldMarginMm = 120.0;
constexpr double kBodyRimMm = 2.5;
// A robot of unknown id that was hardly seen may have been noise: it is not carried on.
constexpr int kProvenFrames = 3;
constexpr std::size_t kUsualTracks = 64;
// Of a robot whose front and back cannot be told apart.
constexpr double kHeadlessConfidence = 0.3;

}  // namespace

RobotTracker::RobotTracker(const TrackingParameters& parameters,
                           std::span<const LayoutModel> layouts)
    : parameters_(parameters),
      layouts_(layouts),
      blobs_(parameters, layouts),
      generator_(parameters, layouts),
      claims_(parameters, layouts) {
  tracks_.reserve(kUsualTracks);
  next_.reserve(kUsualTracks);
  candidates_.reserve(4 * kUsualTracks);
}

void RobotTracker::track(const TrackerInput& input, double dt_s) {
  for (RobotTrack& track : tracks_) track.predict(dt_s, parameters_);
  blobs_.load(input.blobs, input.field);
  candidates_.clear();
  generator_.generate(blobs_, candidates_);
  const FieldParameters& field = input.field.parameters();
  const cv::Point2d limit_mm(field.length_mm / 2.0 + kFieldMarginMm,
                             field.width_mm / 2.0 + kFieldMarginMm);
  claims_.build(blobs_, tracks_, limit_mm, candidates_);
  const std::uint64_t before = solver_.cut_short();
  solver_.solve(claims_.contenders(), claims_.conflicts(), chosen_);
  is_cut_short_ = blobs_.is_cut_short() || generator_.is_cut_short() || claims_.is_cut_short() ||
                  solver_.cut_short() > before;
  continue_tracks();
  keep_unseen_tracks(limit_mm);
  std::swap(tracks_, next_);
  limit_team(Team::kBlue);
  limit_team(Team::kYellow);
}

void RobotTracker::continue_tracks() {
  fill_with_room(taken_, tracks_.size(), 0);
  fill_with_room(sources_, chosen_.size(), -1);
  next_.clear();
  // Claims that name their track go first; the others share what is left.
  for (const bool by_motion : {true, false}) {
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const Claim& claim = claims_.claims()[static_cast<std::size_t>(chosen_[i])];
      if ((claim.track >= 0) != by_motion) continue;
      sources_[i] = by_motion ? claim.track : motion_source(claim);
      if (sources_[i] >= 0) taken_[static_cast<std::size_t>(sources_[i])] = 1;
    }
  }
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const Claim& claim = claims_.claims()[static_cast<std::size_t>(chosen_[i])];
    const Candidate& sighting = candidate_of(claim);
    RobotTrack track;
    if (sources_[i] >= 0) {
      track = tracks_[static_cast<std::size_t>(sources_[i])];
      track.update(sighting, claim.id, parameters_);
    } else {
      track.start(sighting, claim.id, parameters_);
    }
    track.candidate = claim.candidate;
    track.confidence = rate(sighting, claim.id);
    if (!track.heading_known) track.confidence = std::min(track.confidence, kHeadlessConfidence);
    track.player_colors.clear();
    for (int k = 1; sighting.found > 1 && k < static_cast<int>(kMaxPatches); ++k) {
      const int blob = sighting.blobs[static_cast<std::size_t>(k)];
      if (blob < 0) continue;
      track.player_colors.push_back(blobs_.all()[static_cast<std::size_t>(blob)].label);
    }
    next_.push_back(track);
  }
}

// A robot whose colours name an id that was not here: it moved here under that id, or was followed
// under another one.
int RobotTracker::motion_source(const Claim& claim) const {
  const Candidate& sighting = candidate_of(claim);
  int nearest = -1;
  double nearest_mm = 0.0;
  int own = -1;
  for (int t = 0; t < static_cast<int>(tracks_.size()); ++t) {
    const RobotTrack& track = tracks_[static_cast<std::size_t>(t)];
    if (taken_[static_cast<std::size_t>(t)] || track.team != sighting.team ||
        track.heading_known != sighting.heading_known) {
      continue;
    }
    const cv::Point2d off = sighting.pose.position_mm - track.pose().position_mm;
    const double distance = length_of(off);
    if (distance <= track.gate_mm(parameters_) && (nearest < 0 || distance < nearest_mm)) {
      nearest = t;
      nearest_mm = distance;
    }
    if (claim.id >= 0 && track.id == claim.id && distance <= track.max_travel_mm(parameters_)) {
      own = t;
    }
  }
  return nearest >= 0 ? nearest : own;
}

void RobotTracker::keep_unseen_tracks(cv::Point2d limit_mm) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (taken_[t]) continue;
    RobotTrack& track = tracks_[t];
    const auto same_id = [&](const RobotTrack& other) {
      return track.id >= 0 && other.id == track.id && other.team == track.team;
    };
    if (++track.missed_frames > parameters_.predict_frames ||
        (track.id == kUnknownId && track.seen_frames < kProvenFrames) ||
        std::ranges::any_of(next_, same_id)) {
      continue;
    }
    track.position.clamp(limit_mm);
    if (!overlaps_kept(track)) next_.push_back(track);
  }
}

bool RobotTracker::overlaps_kept(const RobotTrack& track) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(track.layout)];
  return std::ranges::any_of(next_, [&](const RobotTrack& other) {
    const cv::Point2d apart = other.pose().position_mm - track.pose().position_mm;
    return length_of(apart) <
           min_separation_mm(layout, layouts_[static_cast<std::size_t>(other.layout)]);
  });
}

void RobotTracker::limit_team(Team team) {
  const auto count = [&] { return std::ranges::count(tracks_, team, &RobotTrack::team); };
  for (auto excess = count() - parameters_.max_robots_per_team; excess > 0; --excess) {
    // Unknown before known, unseen before seen, then the least convincing.
    auto worst = tracks_.end();
    const auto worth = [&](const RobotTrack& track) {
      return (track.id >= 0 ? 4.0 : 0.0) + (track.missed_frames == 0 ? 2.0 : 0.0) +
             confidence(track);
    };
    for (auto it = tracks_.begin(); it != tracks_.end(); ++it) {
      if (it->team == team && (worst == tracks_.end() || worth(*it) < worth(*worst))) worst = it;
    }
    tracks_.erase(worst);
  }
}

double RobotTracker::half_body_mm(const RobotTrack& track) const {
  return layouts_[static_cast<std::size_t>(track.layout)].half_extent_mm + kBodyRimMm;
}

double RobotTracker::rate(const Candidate& candidate, int id) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(candidate.layout)];
  const double most = kPatchScore * static_cast<double>(layout.patches.size());
  const double fit = std::clamp(candidate.score / most, 0.1, 1.0);
  return candidate.complete && candidate.color_id == id ? fit : 0.8 * fit;
}

double RobotTracker::confidence(const RobotTrack& track) const {
  return track.confidence *
         (1.0 - static_cast<double>(track.missed_frames) / (parameters_.predict_frames + 1.0));
}

void RobotTracker::report(const TrackerInput& input, Detections& out) {
  const auto before = [](const RobotTrack& a, const RobotTrack& b) {
    const auto rank = [](const RobotTrack& track) {
      return static_cast<unsigned>(track.id);  // kUnknownId comes last
    };
    return a.team != b.team ? a.team < b.team : rank(a) < rank(b);
  };
  // By insertion: stable like std::stable_sort, which would allocate, and nearly sorted already.
  for (auto it = tracks_.begin(); it != tracks_.end(); ++it) {
    std::rotate(std::upper_bound(tracks_.begin(), it, *it, before), it, it + 1);
  }
  for (const RobotTrack& track : tracks_) {
    describe_robot(input, track, out.robots.emplace_back());
  }
}

void RobotTracker::describe_robot(const TrackerInput& input, const RobotTrack& track,
                                  RobotDetection& robot) const {
  const LayoutModel& layout = layouts_[static_cast<std::size_t>(track.layout)];
  robot.team = track.team;
  robot.id = track.id;
  robot.player_colors.assign(track.player_colors.begin(), track.player_colors.end());
  robot.position_mm = track.position.position_mm();
  robot.heading_rad = wrap_turn(track.heading.heading_rad() + layout.heading_offset_rad);
  robot.velocity_mm_s = track.position.velocity_mm_s();
  robot.angular_velocity_rad_s = track.heading.rate_rad_s();
  robot.centroid_px = input.field.to_image_px(robot.position_mm, input.field.robot_height_mm());
  robot.confidence = confidence(track);
  robot.state = track.missed_frames == 0 ? TrackState::kSeen : TrackState::kPredicted;
  if (track.candidate < 0) return;
  for (const int index : candidates_[static_cast<std::size_t>(track.candidate)].blobs) {
    if (index < 0) continue;
    const MetricBlob& metric = blobs_.all()[static_cast<std::size_t>(index)];
    // A merged blob is shared by two robots, so it is neither's tag.
    if (metric.is_half()) continue;
    const Blob& blob = input.blobs[static_cast<std::size_t>(metric.source)];
    robot.tags.push_back({blob.label, blob.centroid_px, static_cast<double>(blob.area_px)});
  }
}

}  // namespace maggic::tracking
