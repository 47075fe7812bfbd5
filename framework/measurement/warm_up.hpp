#pragma once
/// The frames before those that are measured.

#include <cstdint>

#include "maggic/frame_store.hpp"
#include "maggic/pipeline.hpp"

namespace maggic {

inline constexpr std::uint64_t kWarmUpFrames = 20;

/// Sends the first frames through, so that buffers have grown and tracks stand.
inline void warm_up(Pipeline& pipeline, const FrameStore& store, FrameResult& result) {
  for (std::uint64_t i = 0; i < kWarmUpFrames; ++i) {
    store.get(i, result.frame);
    pipeline.process(result);
  }
}

}  // namespace maggic
