#pragma once
/// Trackers: turn the blobs of a frame into robots and ball, and keep them over time.

#include <cstdint>
#include <span>

#include "maggic/blob.hpp"
#include "maggic/detections.hpp"
#include "maggic/field.hpp"
#include "maggic/frame.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// What a tracker is given for one frame. Everything is valid for the call only.
struct TrackerInput {
  std::uint64_t sequence = 0;
  Timestamp captured{0};  ///< Never before the previous frame's, unless a recording looped.
  std::span<const Blob> blobs;  ///< In no particular order.
  const Field& field;           ///< Pixels to millimetres for this frame's size.
};

class Tracker : public Stage {
 public:
  /// Fills `out` with what is in the frame; `out.sequence` and `out.captured` are the input's.
  /// Contract: deterministic; an id occurs at most once a team; a blob belongs to at most one
  /// object; positions, velocities and headings are finite; confidence in (0, 1]; robots in the
  /// order Detections states. A time that goes backwards or jumps forgets motion, never crashes.
  /// `out` may hold an earlier frame's data: overwrite it.
  virtual void track(const TrackerInput& input, Detections& out) = 0;
};

}  // namespace maggic
