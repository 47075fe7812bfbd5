#include "calibration/strays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/pattern_score.hpp"
#include "tracking/metric_blob.hpp"

namespace maggic::calibration {
namespace {

// As the tracker's own limits: smaller and larger blobs are left alone by it.
constexpr double kMinPatchRatio = 0.3;
constexpr double kMaxPatchRatio = 2.0;
constexpr double kMinBallRatio = 0.25;
constexpr double kMaxBallRatio = 2.5;
// Pieces of lines and cables have the area, but not the shape. Trackers take even half a ball.
constexpr double kMaxTagElongation = 2.8;
constexpr double kMaxBallElongation = 2.2;
constexpr double kMinTagFill = 0.85;
constexpr double kMinBallFill = 0.7;
constexpr double kBesideFieldMm = 50.0;

class StrayFinder {
 public:
  StrayFinder(Pipeline& pipeline, const TrackedPattern& pattern, const std::set<Identity>& known)
      : pipeline_(pipeline), pattern_(pattern), known_(known) {}

  std::vector<Stray> look_at(const FrameResult& result, const std::optional<Patch>& ball) {
    result_ = &result;
    std::vector<Stray> strays;
    for (const Blob& blob : result.blobs) {
      if (!is_on_field(blob)) continue;
      if (is_stray_tag(blob) || (ball && is_stray_ball(blob, *ball))) {
        strays.push_back({blob.centroid_px, static_cast<double>(blob.area_px)});
      }
    }
    for (const RobotDetection& robot : result_->detections.robots) {
      if (robot.id == kUnknownId || is_known(robot)) continue;
      for (const TagSighting& tag : robot.tags) strays.push_back({tag.centroid_px, tag.area_px});
    }
    return strays;
  }

 private:
  bool is_known(const RobotDetection& robot) const {
    return known_.contains(identity_of(robot, pattern_));
  }

  tracking::MetricBlob metric(const Blob& blob, double height_mm) const {
    return tracking::to_metric(blob, 0, *pipeline_.field(), height_mm);
  }

  /// What lies beyond the walls moves no tracker and may be left as it is.
  bool is_on_field(const Blob& blob) const {
    const Field& field = *pipeline_.field();
    const cv::Point2d place = field.to_field_mm(blob.centroid_px, 0.0);
    return std::abs(place.x) <= field.parameters().length_mm / 2.0 + kBesideFieldMm &&
           std::abs(place.y) <= field.parameters().width_mm / 2.0 + kBesideFieldMm;
  }

  bool is_stray_tag(const Blob& blob) const {
    if (blob.label != pattern_.blue_team_color && blob.label != pattern_.yellow_team_color) {
      return false;
    }
    const tracking::MetricBlob seen = metric(blob, pipeline_.field()->robot_height_mm());
    if (seen.elongation() > kMaxTagElongation || seen.fill() < kMinTagFill) return false;
    const bool has_size = std::ranges::any_of(pattern_.layouts, [&](const TagLayout& layout) {
      return std::ranges::any_of(layout.patches, [&](const TagPatch& patch) {
        const double ratio = seen.area_mm2 / patch.expected_area_mm2();
        return patch.role == PatchRole::kTeam && ratio >= kMinPatchRatio && ratio <= kMaxPatchRatio;
      });
    });
    return has_size && !is_on_robot(blob);
  }

  bool is_stray_ball(const Blob& blob, const Patch& ball) const {
    if (blob.label != pattern_.ball_color) return false;
    const double disc_mm2 = std::numbers::pi / 4.0 * std::pow(pattern_.ball_diameter_mm, 2);
    const tracking::MetricBlob seen = metric(blob, pipeline_.field()->ball_height_mm());
    if (seen.elongation() > kMaxBallElongation || seen.fill() < kMinBallFill) return false;
    const double ratio = seen.area_mm2 / disc_mm2;
    if (ratio < kMinBallRatio || ratio > kMaxBallRatio) return false;
    const double radius_px = std::sqrt(ball.area_px / std::numbers::pi);
    return cv::norm(blob.centroid_px - ball.centroid_px) > 2.0 * radius_px && !is_on_robot(blob);
  }

  bool is_on_robot(const Blob& blob) const {
    return std::ranges::any_of(result_->detections.robots, [&](const RobotDetection& robot) {
      if (robot.id == kUnknownId || !is_known(robot)) return false;
      return std::ranges::any_of(robot.tags, [&](const TagSighting& tag) {
        return cv::norm(tag.centroid_px - blob.centroid_px) < std::sqrt(tag.area_px);
      });
    });
  }

  Pipeline& pipeline_;
  const TrackedPattern& pattern_;
  const std::set<Identity>& known_;
  const FrameResult* result_ = nullptr;
};

}  // namespace

Identity identity_of(const RobotDetection& robot, const TrackedPattern& pattern) {
  const Label team =
      robot.team == Team::kBlue ? pattern.blue_team_color : pattern.yellow_team_color;
  return {team, {robot.player_colors.begin(), robot.player_colors.end()}};
}

std::vector<std::vector<Stray>> find_strays(Pipeline& pipeline, std::span<const cv::Mat> frames,
                                            const BallSightings& ball,
                                            const TrackedPattern& pattern,
                                            const std::set<Identity>& known) {
  StrayFinder finder(pipeline, pattern, known);
  std::vector<std::vector<Stray>> strays(frames.size());
  score_by_pattern(pipeline, frames, [&](const FrameResult& result) {
    const std::size_t f = result.frame.sequence;
    strays[f] = finder.look_at(result, ball.by_frame[f]);
  });
  return strays;
}

}  // namespace maggic::calibration
