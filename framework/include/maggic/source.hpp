#pragma once
/// Sources: where frames come from.

#include <cstdint>
#include <optional>

#include "maggic/frame.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// What a source knows about itself once open.
struct SourceInfo {
  /// Live sources are never waited for: the newest frame wins and older ones are dropped and
  /// counted. From any other source nothing is dropped.
  bool live = false;
  std::optional<std::uint64_t> frame_count;  ///< When known and finite; for progress bars.
  double frames_per_second = 0.0;            ///< Nominal; 0 when unknown.
};

enum class ReadStatus {
  kFrame,  ///< `frame` was filled.
  kRetry,  ///< Nothing to give just now (camera unplugged, unreadable picture); call again.
  kEnd,    ///< There is nothing more; every further call says so too.
};

class Source : public Stage {
 public:
  /// Opens the device or file. Called once, after `prepare`, before the first `read`.
  /// @throws std::exception when it cannot be opened and trying again would not help.
  virtual SourceInfo open() = 0;

  /// Fills `frame.bgr` (8-bit, three channels, or any other type the host converts) and
  /// `frame.captured`, and `frame.truth` with `has_truth` and `frame.truth_labels` if the source knows
  /// them; the host sets `sequence`. `frame.bgr` may hold a buffer of an earlier frame: write into it if it fits (cv
  /// functions do), so that nothing is allocated; never keep a reference to it.
  /// May block up to about 200 ms, then answer kRetry, so that the host can end the run.
  virtual ReadStatus read(Frame& frame) = 0;
};

}  // namespace maggic
