#pragma once
/// Everything known about one frame once it went through a pipeline: what sinks are given.

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <vector>

#include "maggic/blob.hpp"
#include "maggic/detections.hpp"
#include "maggic/frame.hpp"

namespace maggic {

/// The steps of the frame path that are timed.
enum class Step : std::size_t { kRead, kSegment, kBlobs, kTrack, kCount };

/// "read", "segment", "blobs", "track".
std::string_view name_of(Step step);

/// Wall time of each step of one frame. `kRead` runs on the capture thread and is not part of
/// `frame_path()`.
struct StepTimes {
  std::array<std::chrono::nanoseconds, static_cast<std::size_t>(Step::kCount)> of{};

  std::chrono::nanoseconds& operator[](Step s) { return of[static_cast<std::size_t>(s)]; }
  std::chrono::nanoseconds operator[](Step s) const { return of[static_cast<std::size_t>(s)]; }
  /// Pixels to detections: segment + blobs + track.
  std::chrono::nanoseconds frame_path() const {
    return (*this)[Step::kSegment] + (*this)[Step::kBlobs] + (*this)[Step::kTrack];
  }
};

/// One frame with all that was made of it. Pooled: memory is reused once every sink let go.
struct FrameResult {
  Frame frame;
  std::vector<Run> runs;  ///< Rows ascending, columns ascending within a row.
  std::vector<Blob> blobs;
  Detections detections;
  StepTimes times;
};

}  // namespace maggic
