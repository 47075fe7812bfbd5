/// From pixels to runs: nanoseconds a pixel over typical and worst pictures.

#include <vector>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "maggic/run_extractor.hpp"

namespace maggic {
namespace {

void extract(benchmark::State& state) {
  const auto scene = static_cast<bench::Scene>(state.range(0));
  const cv::Mat frame = bench::frame_of(
      scene, {static_cast<int>(state.range(1)), static_cast<int>(state.range(2))});
  const ColorTable& table = bench::maggic_table();
  std::vector<Run> runs;
  for (auto _ : state) {
    extract_runs(frame, table, runs);
    benchmark::DoNotOptimize(runs.data());
  }
  state.SetLabel(bench::name_of(scene));
  state.counters["runs"] = static_cast<double>(runs.size());
  const auto seconds_per_item =
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["s/pixel"] =
      benchmark::Counter(static_cast<double>(frame.total()), seconds_per_item);
}

BENCHMARK(extract)
    ->ArgsProduct({{0, 1, 2, 3, 4}, {640}, {480}})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {1920}, {1080}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace maggic
