#include <atomic>
#include <memory>
#include <stdexcept>

#include "maggic/runner.hpp"
#include "maggic/speed_measurement.hpp"
#include "measurement/replay_source.hpp"
#include "measurement/samples.hpp"
#include "measurement/warm_up.hpp"

namespace maggic {

LatencySpeed measure_latency(BuiltPipeline& built, const FrameStore& store, std::uint64_t frames,
                             Reporter& reporter) {
  built.sinks.clear();
  built.source = {"replay", StagePtr<Source>(std::make_unique<ReplaySource>(store).release())};
  RunOptions options;
  options.max_frames = frames + kWarmUpFrames;
  const std::atomic<bool> stop{false};
  Samples samples(static_cast<std::size_t>(frames));
  const RunSummary summary =
      run(built, options, stop, reporter, [&](const FrameResult& result, const RunSummary& so_far) {
        const Timestamp found = ReplaySource::now();
        if (so_far.taken() > kWarmUpFrames) samples.add(found - result.frame.captured);
      });
  if (!summary.first_error.empty()) throw std::runtime_error(summary.first_error);
  return {samples.figures(), summary.source.frames_per_second, frames, summary.dropped};
}

}  // namespace maggic
