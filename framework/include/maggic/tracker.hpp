#pragma once
/// Trackers: turn the blobs of a frame into robots and ball, and keep them over time.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "maggic/blob.hpp"
#include "maggic/detections.hpp"
#include "maggic/field.hpp"
#include "maggic/frame.hpp"
#include "maggic/stage.hpp"
#include "maggic/tag_layout.hpp"

namespace maggic {

/// What a tracker is given for one frame. Everything is valid for the call only.
struct TrackerInput {
  std::uint64_t sequence = 0;
  Timestamp captured{0};  ///< Never before the previous frame's, unless a recording looped.
  std::span<const Blob> blobs;  ///< In no particular order.
  const Field& field;           ///< Pixels to millimetres for this frame's size.
};

/// What a tracker looks for. Calibration learns the colours of a venue from it.
struct TrackedPattern {
  std::vector<TagLayout> layouts;
  Label blue_team_color = kBackground;
  Label yellow_team_color = kBackground;
  Label ball_color = kBackground;
  double ball_diameter_mm = 0.0;
};

class Tracker : public Stage {
 public:
  /// What this tracker looks for; valid after `prepare`. Nothing: it does not work by tag patterns,
  /// and calibration cannot help it.
  virtual std::optional<TrackedPattern> pattern() const { return std::nullopt; }

  /// Fills `out` with what is in the frame; `out.sequence` and `out.captured` are the input's.
  /// Contract: deterministic; an id occurs at most once a team; a blob belongs to at most one
  /// object; positions, velocities and headings are finite; confidence in (0, 1]; robots in the
  /// order Detections states. A time that goes backwards or jumps forgets motion, never crashes.
  /// `out` may hold an earlier frame's data: overwrite it.
  virtual void track(const TrackerInput& input, Detections& out) = 0;

  /// What the last `track` made of one blob, as `maggic run --why` asks: the object it belongs to,
  /// or the rule that kept it from being one, with its numbers and the parameters to turn. One
  /// sentence a line; empty: the tracker does not say.
  /// @param input the very input of the last `track`. @param blob index into its blobs.
  /// @param palette names the colours in the answer.
  virtual std::string explain(const TrackerInput& /*input*/, std::size_t /*blob*/,
                              const Palette& /*palette*/) const {
    return {};
  }
};

}  // namespace maggic
