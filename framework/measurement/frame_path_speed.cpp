#include <algorithm>
#include <vector>

#include "maggic/speed_measurement.hpp"
#include "measurement/cache_eviction.hpp"
#include "measurement/samples.hpp"
#include "measurement/warm_up.hpp"
#include "measurement/yardsticks.hpp"

namespace maggic {
namespace {

/// Times of the frame path's steps, and what they were given to do.
struct StepSamples {
  explicit StepSamples(std::size_t frames)
      : segment(frames), blobs(frames), track(frames), to_blobs(frames), to_detections(frames) {}

  void add(const FrameResult& result) {
    const StepTimes& times = result.times;
    segment.add(times[Step::kSegment]);
    blobs.add(times[Step::kBlobs]);
    track.add(times[Step::kTrack]);
    to_blobs.add(times[Step::kSegment] + times[Step::kBlobs]);
    runs += static_cast<double>(result.runs.size());
    found_blobs += static_cast<double>(result.blobs.size());
    robots += static_cast<double>(result.detections.robots.size());
  }

  Samples segment, blobs, track, to_blobs, to_detections;
  double runs = 0.0;
  double found_blobs = 0.0;
  double robots = 0.0;
};

}  // namespace

FramePathSpeed measure_frame_path(Pipeline& pipeline, const FrameStore& store,
                                  std::uint64_t frames) {
  const auto count = static_cast<std::size_t>(frames);
  CacheEvictor caches;
  FrameResult result;
  cv::Mat bytes;
  cv::Mat labels;
  std::vector<Label> flat;
  if (const ColorTable* table = pipeline.color_table()) flat = flat_labels(*table);
  warm_up(pipeline, store, result);
  join_channels(result.frame.bgr, bytes);
  if (!flat.empty()) look_up_each_pixel(result.frame.bgr, flat, labels);

  Samples floor(count);
  Samples plain(count);
  StepSamples steps(count);
  for (std::uint64_t i = 0; i < frames; ++i) {
    store.get(kWarmUpFrames + i, result.frame);
    caches.evict();
    floor.time([&] { join_channels(result.frame.bgr, bytes); });
    if (!flat.empty()) {
      caches.evict();
      plain.time([&] { look_up_each_pixel(result.frame.bgr, flat, labels); });
    }
    caches.evict();
    steps.to_detections.time([&] { pipeline.process(result); });
    steps.add(result);
  }

  FramePathSpeed speed;
  speed.floor = floor.figures();
  if (!flat.empty()) speed.plain_table = plain.figures();
  speed.segment = steps.segment.figures();
  speed.blobs = steps.blobs.figures();
  speed.track = steps.track.figures();
  speed.pixels_to_blobs = steps.to_blobs.figures();
  speed.pixels_to_detections = steps.to_detections.figures();
  const double measured = static_cast<double>(frames);
  speed.runs_a_frame = steps.runs / measured;
  speed.blobs_a_frame = steps.found_blobs / measured;
  speed.robots_a_frame = steps.robots / measured;
  return speed;
}

}  // namespace maggic
