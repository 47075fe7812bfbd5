/// RobotTracker's answers to why a blob is, or is not, part of a robot.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "tracking/robot_tracker.hpp"

namespace maggic::tracking {
namespace {

// Neighbours named in an answer; more would bury the one that matters.
constexpr std::size_t kMaxNeighbors = 2;

std::string robot_name(Team team, int id) {
  if (id == kUnknownId) return fmt::format("a {} robot of unknown id", name_of(team));
  return fmt::format("{} robot {}", name_of(team), id);
}

class Explanation {
 public:
  Explanation(const RobotEvidence& evidence, const TrackerInput& input, std::size_t blob,
              const Palette& palette)
      : evidence_(evidence), input_(input), blob_(static_cast<int>(blob)), palette_(palette) {}

  std::string owner() const {
    for (const RobotTrack& track : evidence_.tracks) {
      if (track.missed_frames > 0 || track.candidate < 0) continue;
      const Candidate& sighting = candidate_at(track.candidate);
      const int patch = patch_of(sighting);
      if (patch >= 0) return owner_text(track, sighting, patch);
    }
    return {};
  }

  std::string refusal() const {
    const int index = own_index();
    if (index < 0) return no_patch_text();
    if (const int fit = best_candidate(); fit >= 0) return lost_text(fit);
    return evidence_.blobs.is_team_color(label()) ? no_player_text(at(index))
                                                  : no_team_text(at(index));
  }

 private:
  const MetricBlob& at(int index) const {
    return evidence_.blobs.all()[static_cast<std::size_t>(index)];
  }
  const Candidate& candidate_at(int index) const {
    return evidence_.candidates[static_cast<std::size_t>(index)];
  }
  const LayoutModel& layout_at(int index) const {
    return evidence_.layouts[static_cast<std::size_t>(index)];
  }
  Label label() const { return input_.blobs[static_cast<std::size_t>(blob_)].label; }
  std::string_view color_of(const MetricBlob& blob) const { return palette_.name(blob.label); }

  /// "red blob at 204,430"
  std::string name_of_blob(const MetricBlob& blob) const {
    const cv::Point2d at_px = input_.blobs[static_cast<std::size_t>(blob.source)].centroid_px;
    return fmt::format("{} blob at {:.0f},{:.0f}", color_of(blob), at_px.x, at_px.y);
  }
  std::string place_text(const Candidate& candidate) const {
    const cv::Point2d at_px =
        input_.field.to_image_px(candidate.pose.position_mm, input_.field.robot_height_mm());
    return fmt::format("{:.0f},{:.0f}", at_px.x, at_px.y);
  }

  /// Which patch of a candidate the blob is, whole or half; -1: none.
  int patch_of(const Candidate& candidate) const {
    for (std::size_t k = 0; k < candidate.blobs.size(); ++k) {
      if (candidate.blobs[k] >= 0 && at(candidate.blobs[k]).source == blob_) {
        return static_cast<int>(k);
      }
    }
    return -1;
  }

  /// The blob as a whole among those looked at; -1 when it is not.
  int own_index() const {
    const std::vector<MetricBlob>& all = evidence_.blobs.all();
    const auto own = std::ranges::find_if(
        all, [&](const MetricBlob& blob) { return blob.source == blob_ && !blob.is_half(); });
    return own == all.end() ? -1 : static_cast<int>(own - all.begin());
  }

  std::string colors_text(const Candidate& candidate) const {
    std::string names;
    for (std::size_t k = 1; k < candidate.blobs.size(); ++k) {
      if (candidate.blobs[k] < 0) continue;
      names += fmt::format("{}{}", names.empty() ? "" : ", ", color_of(at(candidate.blobs[k])));
    }
    return names;
  }

  std::string owner_text(const RobotTrack& track, const Candidate& sighting, int patch) const {
    const std::string role = patch == 0 ? "team patch" : fmt::format("player patch {}", patch);
    const bool is_half = at(sighting.blobs[static_cast<std::size_t>(patch)]).is_half();
    std::string text = fmt::format("{}{} of {} at {}", is_half ? "half of it is the " : "", role,
                                   robot_name(track.team, track.id), place_text(sighting));
    if (sighting.found > 1) text += fmt::format(", {}", partners_text(sighting));
    const LayoutModel& layout = layout_at(sighting.layout);
    if (sighting.found <= 1) {
      text += "\nno player patch was found with it";
      if (track.id != kUnknownId) text += fmt::format("; id {} is known from before", track.id);
      text += fmt::format(": {}", partner_text(at(sighting.blobs[0]), layout));
    } else if (!sighting.complete) {
      text +=
          fmt::format("\n{} of its {} patches were found", sighting.found, layout.patches.size());
    } else if (sighting.color_id == kUnknownId) {
      text += fmt::format("\nits player colours ({}) are in no id table", colors_text(sighting));
    } else if (sighting.color_id != track.id) {
      text += fmt::format(
          "\nits player colours ({}) say id {}: believed once they say so {} frames in a row",
          colors_text(sighting), sighting.color_id, kSwitchFrames);
    }
    return text;
  }

  /// Why the blob was not even looked at.
  std::string no_patch_text() const {
    const Blob& blob = input_.blobs[static_cast<std::size_t>(blob_)];
    if (!evidence_.blobs.is_team_color(blob.label) && !evidence_.blobs.may_be_player(blob.label)) {
      return fmt::format(
          "no part of a robot: {} is neither a team's colour nor a player colour of "
          "any id",
          palette_.name(blob.label));
    }
    const MetricBlob metric = to_metric(blob, blob_, input_.field, input_.field.robot_height_mm());
    const double least = evidence_.blobs.min_area_mm2();
    const double most = evidence_.blobs.max_area_mm2();
    if (metric.area_mm2 < least) {
      return fmt::format(
          "no part of a robot: {:.0f} mm² is less than any patch shows ({:.0f} mm² with "
          "patch_min_area_ratio {})",
          metric.area_mm2, least, evidence_.parameters.patch_min_area_ratio);
    }
    if (metric.area_mm2 > most) {
      return fmt::format(
          "no part of a robot: {:.0f} mm² is more than any patch, or two run into each other, show "
          "({:.0f} mm²)",
          metric.area_mm2, most);
    }
    return "no part of a robot: the frame has more blobs in tag colours than are looked at, and "
           "the smallest were left out";
  }

  /// "400 mm² are 0.16 of a player patch's 2450 mm², patch_min_area_ratio is 0.3"
  std::string area_text(const MetricBlob& blob, const PatchModel& patch,
                        std::string_view role) const {
    const double ratio = blob.area_mm2 / patch.area_mm2;
    const TrackingParameters& parameters = evidence_.parameters;
    const bool small = ratio < parameters.patch_min_area_ratio;
    return fmt::format("its {:.0f} mm² are {:.3g} of a {} patch's {:.0f} mm², {} is {}",
                       blob.area_mm2, ratio, role, patch.area_mm2,
                       small ? "patch_min_area_ratio" : "patch_max_area_ratio",
                       small ? parameters.patch_min_area_ratio : parameters.patch_max_area_ratio);
  }

  std::string refusal_text(PatchRefusal refusal, const LayoutModel& layout, const MetricBlob& team,
                           int patch, const MetricBlob& blob) const {
    const PatchModel& model = layout.patches[static_cast<std::size_t>(patch)];
    const cv::Point2d expected = model.center_mm - layout.team().center_mm;
    switch (refusal) {
      case PatchRefusal::kNone:
        return fmt::format(
            "fits by itself, but not with the pattern's other patches within "
            "max_patch_error_mm {}",
            evidence_.parameters.max_patch_error_mm);
      case PatchRefusal::kTwoHalves: return "both are half of a blob of twice the size";
      case PatchRefusal::kColor: return fmt::format("{} is no player colour", color_of(blob));
      case PatchRefusal::kArea: return area_text(blob, model, "player");
      case PatchRefusal::kOutOfReach:
      case PatchRefusal::kDistance: break;
    }
    const cv::Point2d apart = blob.position_mm - team.position_mm;
    return fmt::format("{:.0f} mm apart, expected {:.0f} ± {:.0f} mm", length_of(apart),
                       length_of(expected), evidence_.generator.distance_tolerance_mm(team, blob));
  }

  struct Neighbor {
    int index = 0;
    double distance_mm = 0.0;
  };

  /// Whole blobs of which `wanted` holds, the nearest first.
  template <class Wanted>
  std::vector<Neighbor> neighbors(const MetricBlob& of, Wanted wanted) const {
    std::vector<Neighbor> found;
    const std::vector<MetricBlob>& all = evidence_.blobs.all();
    for (int b = 0; b < static_cast<int>(all.size()); ++b) {
      if (at(b).is_half() || at(b).source == of.source || !wanted(at(b))) continue;
      const cv::Point2d apart = at(b).position_mm - of.position_mm;
      found.push_back({b, length_of(apart)});
    }
    std::ranges::sort(found, {}, &Neighbor::distance_mm);
    return found;
  }

  /// What kept a blob from being a player patch: the rule of the patch that came nearest.
  std::string nearest_refusal_text(const LayoutModel& layout, const MetricBlob& team,
                                   const MetricBlob& blob) const {
    PatchRefusal nearest = PatchRefusal::kOutOfReach;
    int nearest_patch = 1;
    const auto rank = [](PatchRefusal refusal) {
      return refusal == PatchRefusal::kNone ? 9 : static_cast<int>(refusal);
    };
    for (int patch = 1; patch <= layout.player_count(); ++patch) {
      const PatchRefusal refusal =
          evidence_.generator.refusal(evidence_.blobs, layout, team, patch, blob);
      if (rank(refusal) <= rank(nearest)) continue;
      nearest = refusal;
      nearest_patch = patch;
    }
    return refusal_text(nearest, layout, team, nearest_patch, blob);
  }

  /// Why the blobs round a team patch are not its player patches.
  std::string partner_text(const MetricBlob& team, const LayoutModel& layout) const {
    const double reach_mm = evidence_.generator.reach_mm(layout);
    std::string text;
    std::size_t named = 0;
    for (const Neighbor& neighbor : neighbors(team, [&](const MetricBlob& blob) {
           return !evidence_.blobs.is_team_color(blob.label);
         })) {
      if (neighbor.distance_mm > 2.0 * reach_mm || named == kMaxNeighbors) break;
      text += fmt::format("{}{}: {}", named++ == 0 ? "" : "; ", name_of_blob(at(neighbor.index)),
                          nearest_refusal_text(layout, team, at(neighbor.index)));
    }
    if (text.empty()) {
      text = fmt::format("no blob that could be one lies within {:.0f} mm", 2.0 * reach_mm);
    }
    return text;
  }

  std::string no_player_text(const MetricBlob& team) const {
    std::string text;
    for (const LayoutModel& layout : evidence_.layouts) {
      const std::string reason =
          evidence_.blobs.fits_area(layout.team(), team)
              ? fmt::format("no player patch goes with it: {}", partner_text(team, layout))
              : fmt::format("no team patch: {}", area_text(team, layout.team(), "team"));
      if (text.find(reason) == std::string::npos) text += (text.empty() ? "" : "\n") + reason;
    }
    return text;
  }

  std::string no_team_text(const MetricBlob& blob) const {
    const std::vector<Neighbor> teams = neighbors(
        blob, [&](const MetricBlob& other) { return evidence_.blobs.is_team_color(other.label); });
    std::string text;
    if (!evidence_.blobs.is_listed(label())) {
      text = fmt::format("{} is a player colour of no id\n", palette_.name(label()));
    }
    if (teams.empty()) return text + "no team patch goes with it: there is none in the frame";
    for (const LayoutModel& layout : evidence_.layouts) {
      std::size_t named = 0;
      std::string reasons;
      for (const Neighbor& neighbor : teams) {
        const MetricBlob& team = at(neighbor.index);
        const bool out_of_reach = neighbor.distance_mm > 2.0 * evidence_.generator.reach_mm(layout);
        if (named > 0 && (out_of_reach || named == kMaxNeighbors)) break;
        reasons += fmt::format("{}{}: {}", named++ == 0 ? "" : "; ", name_of_blob(team),
                               evidence_.blobs.fits_area(layout.team(), team)
                                   ? nearest_refusal_text(layout, team, blob)
                                   : area_text(team, layout.team(), "team"));
      }
      if (text.find(reasons) == std::string::npos) {
        text += fmt::format("{}no team patch goes with it: {}",
                            text.empty() || text.ends_with('\n') ? "" : "\n", reasons);
      }
    }
    return text;
  }

  /// The most convincing robot the blob could be part of; -1 when there is none.
  int best_candidate() const {
    int best = -1;
    for (int c = 0; c < static_cast<int>(evidence_.candidates.size()); ++c) {
      if (patch_of(candidate_at(c)) < 0) continue;
      if (best < 0 || worth(candidate_at(c)) > worth(candidate_at(best))) best = c;
    }
    return best;
  }
  static double worth(const Candidate& candidate) {
    return candidate.score + (candidate.color_id != kUnknownId ? 100.0 : 0.0);
  }

  std::string partners_text(const Candidate& candidate) const {
    std::string names;
    for (const int index : candidate.blobs) {
      if (index < 0 || at(index).source == blob_) continue;
      names += fmt::format("{}the {}", names.empty() ? "" : ", ", name_of_blob(at(index)));
    }
    return names.empty() ? "alone" : "with " + names;
  }

  /// Why a robot that the blob could be part of is not reported.
  std::string lost_text(int index) const {
    const Candidate& candidate = candidate_at(index);
    const std::string what =
        fmt::format("could be part of {} {}", robot_name(candidate.team, candidate.color_id),
                    partners_text(candidate));
    const std::span<const Claim> claims = evidence_.claims.claims();
    int claim = -1;
    for (int i = 0; i < static_cast<int>(claims.size()); ++i) {
      const auto score_of = [&](int c) {
        return evidence_.claims.contenders()[static_cast<std::size_t>(c)].score;
      };
      if (claims[static_cast<std::size_t>(i)].candidate != index) continue;
      if (claim < 0 || score_of(i) > score_of(claim)) claim = i;
    }
    if (claim < 0) return fmt::format("{}, but {}", what, no_claim_text(candidate));
    if (std::ranges::find(evidence_.chosen, claim) != evidence_.chosen.end()) {
      return fmt::format("{}, but the team has its max_robots_per_team {} already", what,
                         evidence_.parameters.max_robots_per_team);
    }
    return fmt::format("{}, but {}", what, rival_text(claim));
  }

  std::string no_claim_text(const Candidate& candidate) const {
    if (candidate.color_id != kUnknownId) {
      return "the patches fit the pattern too badly in size, shape and place";
    }
    const std::string colors =
        candidate.complete
            ? fmt::format("its player colours ({}) are in no id table", colors_text(candidate))
            : std::string("not all of its patches were found");
    switch (evidence_.claims.refusal_as_unknown(candidate)) {
      case UnknownRefusal::kNotReported: return colors + ", and report_unknown is false";
      case UnknownRefusal::kHalf: return colors + ", and one patch is only half of a blob";
      case UnknownRefusal::kOutside: return colors + ", and it lies outside of the field";
      case UnknownRefusal::kShape:
        return colors + ", and its team patch has not the size and shape of one";
      case UnknownRefusal::kNone: break;
    }
    return colors + ", and the patches fit the pattern too badly in size, shape and place";
  }

  /// Who won over a claim, and why both cannot be.
  std::string rival_text(int claim) const {
    const std::span<const Claim> claims = evidence_.claims.claims();
    const Claim& own = claims[static_cast<std::size_t>(claim)];
    const Candidate& own_sighting = candidate_at(own.candidate);
    const std::span<const Contender> contenders = evidence_.claims.contenders();
    for (const int other : evidence_.chosen) {
      const Claim& rival = claims[static_cast<std::size_t>(other)];
      const Candidate& sighting = candidate_at(rival.candidate);
      const bool same_group = contenders[static_cast<std::size_t>(claim)].group ==
                              contenders[static_cast<std::size_t>(other)].group;
      if (!evidence_.claims.exclude_each_other(claim, other)) continue;
      const bool same_id = own.id >= 0 && own.id == rival.id && own_sighting.team == sighting.team;
      const std::string_view reason = same_id      ? "the id is taken by"
                                      : same_group ? "its team patch belongs to"
                                                   : "its patches or its place belong to";
      return fmt::format("{} {} at {}, which fits better", reason,
                         robot_name(sighting.team, rival.id), place_text(sighting));
    }
    return "the frame held too many possible robots to try them all";
  }

  const RobotEvidence& evidence_;
  const TrackerInput& input_;
  const int blob_;
  const Palette& palette_;
};

}  // namespace

RobotEvidence RobotTracker::evidence() const {
  return {parameters_, layouts_, blobs_, generator_, claims_, candidates_, chosen_, tracks_};
}

std::string RobotTracker::explain_owner(const TrackerInput& input, std::size_t blob,
                                        const Palette& palette) const {
  const RobotEvidence known = evidence();
  return Explanation(known, input, blob, palette).owner();
}

std::string RobotTracker::explain_refusal(const TrackerInput& input, std::size_t blob,
                                          const Palette& palette) const {
  const RobotEvidence known = evidence();
  return Explanation(known, input, blob, palette).refusal();
}

}  // namespace maggic::tracking
