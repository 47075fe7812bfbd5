#pragma once
/// What was found in one frame: robots and ball, in field coordinates.
///
/// Field frame: millimetres, origin at the field's centre, x towards the right goal, y up in the
/// picture; headings in radians, counter-clockwise from +x, in (-pi, pi]. With `half_time` the
/// whole frame is turned by 180° before it is reported.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <boost/container/static_vector.hpp>
#include <opencv2/core/types.hpp>

#include "maggic/palette.hpp"

namespace maggic {

enum class Team : std::uint8_t { kBlue, kYellow };

/// "blue" or "yellow".
constexpr std::string_view name_of(Team team) {
  return team == Team::kBlue ? "blue" : "yellow";
}

/// `kSeen`: found in this frame. `kPredicted`: missed in this frame, carried on by its motion.
enum class TrackState : std::uint8_t { kSeen, kPredicted };

/// "seen" or "predicted".
constexpr std::string_view name_of(TrackState state) {
  return state == TrackState::kSeen ? "seen" : "predicted";
}

/// The most patches a tag layout may have (team patch included).
inline constexpr std::size_t kMaxPatches = 8;

/// A robot's id when its player colours are not in any id table.
inline constexpr int kUnknownId = -1;

/// One tag patch as found in the picture.
struct TagSighting {
  Label label = kBackground;
  cv::Point2d centroid_px;
  double area_px = 0.0;
};

struct RobotDetection {
  Team team = Team::kBlue;
  int id = kUnknownId;
  /// Player colours in the layout's order (team patch left out); empty when only the team patch
  /// was found.
  boost::container::static_vector<Label, kMaxPatches> player_colors;
  cv::Point2d position_mm;
  double heading_rad = 0.0;
  cv::Point2d velocity_mm_s;
  double angular_velocity_rad_s = 0.0;
  cv::Point2d centroid_px;  ///< The robot's centre in the source picture.
  double confidence = 0.0;  ///< (0, 1]; falls while predicted.
  TrackState state = TrackState::kSeen;
  /// Patches found in this frame, team patch first; empty while predicted.
  boost::container::static_vector<TagSighting, kMaxPatches> tags;
};

struct BallDetection {
  Label label = kBackground;  ///< Of the ball's colour.
  cv::Point2d position_mm;
  cv::Point2d velocity_mm_s;
  cv::Point2d centroid_px;
  double area_px = 0.0;
  double confidence = 0.0;
  TrackState state = TrackState::kSeen;
};

/// Everything found in one frame. Reused from frame to frame: `clear()` keeps the memory.
struct Detections {
  std::uint64_t sequence = 0;
  std::chrono::nanoseconds captured{0};
  std::optional<BallDetection> ball;
  std::vector<RobotDetection> robots;  ///< Blue before yellow, ids ascending, unknown ids last.

  void clear() {
    ball.reset();
    robots.clear();
  }
};

}  // namespace maggic
