#pragma once
/// How fast a pipeline is on this machine, beside what the machine itself can do.
///
/// "Cold" means that the caches are evicted before: this core's and the shared one, by reading
/// through memory of twice the last level cache's size. So pictures, tables and results come from
/// main memory, as they do when a camera writes a picture past the caches and other work has run
/// since.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "maggic/duration_figures.hpp"
#include "maggic/frame_store.hpp"
#include "maggic/pipeline.hpp"
#include "maggic/pipeline_builder.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// Every time is of one frame, cold. Yardsticks run on the calling thread, the frame path on as
/// many as the pipeline is configured to use.
struct FramePathSpeed {
  /// Reading all bytes of a picture and writing a byte a pixel, with vector instructions: what no
  /// method that looks at every pixel can go below.
  DurationFigures floor;
  /// A label image by one look-up a pixel in a flat table of all 2^24 colours; nothing where the
  /// pipeline has no colour table.
  std::optional<DurationFigures> plain_table;
  DurationFigures segment;               ///< Pixels to runs.
  DurationFigures blobs;                 ///< Runs to blobs.
  DurationFigures track;                 ///< Blobs to detections.
  DurationFigures pixels_to_blobs;       ///< Segment and blobs.
  DurationFigures pixels_to_detections;  ///< The whole call of Pipeline::process.
  /// Means, to know what the pictures asked for.
  double runs_a_frame = 0.0;
  double blobs_a_frame = 0.0;
  double robots_a_frame = 0.0;
};

/// Measures floor, plain table and frame path in turn on every frame, so that whatever else the
/// machine does hits all alike. A few frames go through before, unmeasured, so that nothing
/// allocates.
/// @param frames at least 1; may be more than `store` holds.
/// @throws what the frame path throws.
FramePathSpeed measure_frame_path(Pipeline& pipeline, const FrameStore& store,
                                  std::uint64_t frames);

struct TableSpeed {
  DurationFigures compile;             ///< Of the colour table, on one thread.
  DurationFigures compile_in_threads;  ///< The same, shared by `threads`.
  DurationFigures update;        ///< On one thread, after a parameter of the segmenter changed.
  DurationFigures memcpy_16mib;  ///< A copy as large as a flat table, for comparison.
};

/// In turn, like the frame path, but with caches as they come.
/// @param changed the pipeline's segmenter with a parameter changed; null: the same again.
/// @param threads at least 1.
/// @return nothing where the pipeline has no colour table.
std::optional<TableSpeed> measure_table(const Pipeline& pipeline, const ColorSegmenter* changed,
                                        unsigned threads, int repetitions);

/// How many frames a second `pipelines` take in all, each on a thread of its own as for a camera
/// each, each given `frames` frames. Caches are as they come; where the store is larger than they
/// are, pictures come from main memory. The median of five rounds.
/// @throws what a frame path throws.
double measure_throughput(std::span<Pipeline* const> pipelines, const FrameStore& store,
                          std::uint64_t frames);

struct LatencySpeed {
  DurationFigures capture_to_detection;
  double frames_per_second = 0.0;  ///< The pace frames came at.
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
};

/// From the moment a picture is in memory to its detections, through the run loop as `run` has it:
/// threads, hand-over, waking up. Frames come at the store's pace, newest first.
/// @param built its source is replaced and its sinks are removed.
/// @throws std::runtime_error when a frame fails.
LatencySpeed measure_latency(BuiltPipeline& built, const FrameStore& store, std::uint64_t frames,
                             Reporter& reporter);

}  // namespace maggic
