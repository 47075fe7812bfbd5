/// From pixels to detections: a whole shipped pipeline, without its source and sinks, over typical
/// and worst pictures of every usual size. Caches are as they come; `maggic bench` measures cold.

#include <chrono>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "bench_report.hpp"
#include "maggic/pipeline_builder.hpp"

namespace maggic {
namespace {

constexpr std::chrono::nanoseconds kPeriod{16'666'667};

void process(benchmark::State& state) {
  const auto scene = static_cast<bench::Scene>(state.range(0));
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = MAGGIC_SOURCE_DIR "/pipelines/maggic_3v3.yaml";
  Pipeline pipeline(build_parts(request, testing::registry(), reporter), reporter);
  FrameResult result;
  result.frame.bgr =
      bench::frame_of(scene, {static_cast<int>(state.range(1)), static_cast<int>(state.range(2))});
  for (auto _ : state) {
    ++result.frame.sequence;
    result.frame.captured += kPeriod;
    pipeline.process(result);
    benchmark::DoNotOptimize(result.detections);
  }
  state.SetLabel(bench::name_of(scene));
  state.counters["runs"] = static_cast<double>(result.runs.size());
  state.counters["blobs"] = static_cast<double>(result.blobs.size());
  state.counters["robots"] = static_cast<double>(result.detections.robots.size());
  bench::report_seconds_per(state, "s/pixel", result.frame.bgr.total());
}

BENCHMARK(process)->Apply(bench::every_scene_and_size);

}  // namespace
}  // namespace maggic
