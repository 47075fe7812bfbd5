#pragma once
/// The engine every shipped tracker shares: match tag layouts to blobs, then keep objects over
/// time.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "maggic/parameters.hpp"
#include "maggic/tag_layout.hpp"
#include "maggic/tracker.hpp"

namespace maggic {

/// Parameters common to every tracker plugin.
struct TrackingParameters {
  Label blue_team_color = kBackground;    ///< Palette colour of the blue team's tags.
  Label yellow_team_color = kBackground;  ///< … and the yellow team's.
  Label ball_color = kBackground;

  double ball_diameter_mm = 42.7;
  double ball_min_area_ratio = 0.25;  ///< Of the disc's area; smaller orange blobs are no ball.
  double ball_max_area_ratio = 2.5;

  double patch_min_area_ratio = 0.3;  ///< Blob area over the patch's own.
  double patch_max_area_ratio = 2.0;
  double max_patch_error_mm = 12.0;   ///< A patch may lie so far from where the pose puts it.

  bool report_unknown = true;         ///< Report team tags whose player colours are unknown.
  int max_robots_per_team = 11;

  int predict_frames = 15;            ///< A missed object is predicted for so many frames.
  double max_speed_mm_s = 3000.0;     ///< Bounds how far an object can move between frames.
  double position_noise_mm = 0.8;     ///< Standard deviation of one measured position.
  double heading_noise_deg = 1.5;
  double acceleration_mm_s2 = 6000.0; ///< How hard objects change their velocity.
  double angular_acceleration_rad_s2 = 120.0;

  /// Finds team and ball colours by name (`blue`, `yellow`, `orange`) where the palette has them.
  void use_palette(const Palette& palette);
  void describe(Parameters& parameters);
};

/// Blobs in, robots and ball out. Assigns over the whole field rather than greedily: every blob
/// to at most one object, every id to at most one robot a team. See docs/adr for the method.
class TrackingEngine {
 public:
  /// @param layouts at least one; ids may overlap between layouts: then the id still occurs once
  ///   a team.
  /// @param reporter told when a frame is so noisy that it was not searched in full; may be null.
  TrackingEngine(const TrackingParameters& parameters, std::vector<TagLayout> layouts,
                 Reporter* reporter = nullptr);
  ~TrackingEngine();

  /// Tracker's contract; see tracker.hpp.
  void track(const TrackerInput& input, Detections& out);

  /// Tracker::explain; see tracker.hpp.
  std::string explain(const TrackerInput& input, std::size_t blob, const Palette& palette) const;

  /// What it was made to look for.
  TrackedPattern pattern() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace maggic
