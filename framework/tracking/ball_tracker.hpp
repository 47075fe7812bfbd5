#pragma once
/// The ball: which blob it is, and its motion.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "maggic/tracker.hpp"
#include "maggic/tracking_engine.hpp"
#include "tracking/metric_blob.hpp"
#include "tracking/motion_filter.hpp"
#include "tracking/pose.hpp"

namespace maggic::tracking {

/// A square no ball can be in.
struct RobotBody {
  Pose pose;
  double half_side_mm = 0.0;
};

class BallTracker {
 public:
  explicit BallTracker(const TrackingParameters& parameters) : parameters_(parameters) {}

  void forget();
  /// @param bodies of the robots seen in this frame.
  void track(const TrackerInput& input, std::span<const RobotBody> bodies, double dt_s);
  void report(const TrackerInput& input, Detections& out) const;

  /// Whether the blob is what the ball was last seen as.
  bool is_seen_as(std::size_t blob) const;
  /// Why a blob of the ball's colour is not the ball. After `track`, with the same arguments.
  std::string explain(const TrackerInput& input, std::span<const RobotBody> bodies,
                      std::size_t blob) const;

 private:
  enum class Refusal { kNone, kArea, kElongated, kHollow, kOutside, kInRobot };
  /// A blob of the ball's colour judged by itself.
  struct Look {
    Refusal refusal = Refusal::kNone;
    MetricBlob metric;
    double area_ratio = 0.0;  ///< Of the ball's disc.
    double likeness = 0.0;    ///< In (0, 1]: size and roundness.
  };
  Look look_at(const TrackerInput& input, std::span<const RobotBody> bodies, int blob) const;
  double disc_mm2() const;
  struct Sighting {
    int source = -1;
    cv::Point2d position_mm;
    double quality = 0.0;  ///< In (0, 1]: size and roundness.
  };
  std::optional<Sighting> best_sighting(const TrackerInput& input,
                                        std::span<const RobotBody> bodies) const;
  void accept(const Sighting& sighting);
  double reach_mm() const;

  const TrackingParameters& parameters_;
  bool known_ = false;
  PositionFilter filter_;
  double unseen_s_ = 0.0;
  int missed_frames_ = 0;
  Sighting seen_;  ///< The last one that was believed.
  /// A place far from where the ball can be, seen in the last frame: believed if seen again.
  std::optional<cv::Point2d> elsewhere_mm_;
};

}  // namespace maggic::tracking
