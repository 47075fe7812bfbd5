#pragma once
/// A camera made of frames in memory.

#include <chrono>
#include <cstdint>

#include "maggic/frame_store.hpp"
#include "maggic/source.hpp"

namespace maggic {

/// Live: a frame is there every `FrameStore::period`, whether or not the last one was taken in
/// time, and `Frame::captured` is the moment it came. Pictures are handed over without being
/// copied, as by a camera that writes to memory by itself.
class ReplaySource final : public Source {
 public:
  /// @param store outlives the source.
  explicit ReplaySource(const FrameStore& store) : store_(store) {}

  /// What `Frame::captured` counts in.
  static Timestamp now();

  SourceInfo open() override;
  ReadStatus read(Frame& frame) override;

 private:
  const FrameStore& store_;
  std::chrono::steady_clock::time_point due_;
  std::uint64_t next_ = 0;
};

}  // namespace maggic
