#pragma once
/// Several pipelines on the very same frames: what A/B tests run on.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "maggic/pipeline.hpp"
#include "maggic/runner.hpp"
#include "maggic/source.hpp"

namespace maggic {

/// Called on the calling thread for each frame that was processed: `results[i]` is what pipeline i
/// made of it, null where that pipeline failed at this frame; `so_far[i]` is how it does.
using OnFrames = std::function<void(std::span<const FrameResult* const> results,
                                    std::span<const RunSummary> so_far)>;

/// Reads every frame once and gives it to each pipeline. Pipelines take turns in being the first,
/// as the first one finds the picture colder in the cache. Live sources: newest frame wins, as in
/// `run`; nothing is dropped for one pipeline only.
/// @param pipelines at least one.
/// @param max_frames stop after so many frames were taken.
/// @return how each pipeline did. A frame that is no usable picture is skipped for all.
/// @throws only what `on_frames` throws.
std::vector<RunSummary> run_side_by_side(NamedStage<Source>& source,
                                         std::span<Pipeline* const> pipelines,
                                         std::optional<std::uint64_t> max_frames,
                                         const std::atomic<bool>& stop, Reporter& reporter,
                                         const OnFrames& on_frames);

}  // namespace maggic
