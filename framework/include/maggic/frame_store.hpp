#pragma once
/// Frames of a source kept in memory, so that reading and decoding them is not measured.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/frame.hpp"
#include "maggic/pipeline.hpp"
#include "maggic/source.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// An endless row of frames: those of a source, and after the last one again from the first, with
/// capture times that go on. Every frame has memory of its own, also where the source gave fewer
/// than were wanted, so the row does not fit a cache because its clip is short.
class FrameStore {
 public:
  struct Limits {
    std::size_t frames = 300;  ///< At least 1.
    std::size_t bytes = std::size_t{512}
                        << 20;  ///< Fewer frames where those take more; at least one.
  };

  /// Opens `source` and reads from it. Pictures are converted as the frame path does; those that
  /// are no pictures, or of another size than the first, are passed over and told to `reporter`.
  /// @throws std::exception when the source does, or when no frame comes: at all, or for 10 s.
  FrameStore(NamedStage<Source>& source, const Limits& limits, Reporter& reporter);

  /// Frame `i` of the row, `i · period()` after the first. Shares its picture: not to be written.
  void get(std::uint64_t i, Frame& frame) const;

  std::size_t size() const { return pictures_.size(); }
  /// How many of them the source gave; the others are copies of these in their order.
  std::size_t given() const { return given_; }
  cv::Size frame_size_px() const { return pictures_.front().size(); }
  /// Between frames: as the source's rate says, else as its capture times do, else 1/60 s.
  std::chrono::nanoseconds period() const { return period_; }

 private:
  void read(NamedStage<Source>& source, const Limits& limits, Reporter& reporter);
  void fill_up(const Limits& limits);
  bool is_full(const Limits& limits) const;

  std::vector<cv::Mat> pictures_;
  std::size_t given_ = 0;
  std::chrono::nanoseconds period_{0};
};

}  // namespace maggic
