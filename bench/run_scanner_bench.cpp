/// From pixels to runs: nanoseconds a pixel over typical and worst pictures.

#include <vector>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "maggic/run_scanner.hpp"

namespace maggic {
namespace {

void scan(benchmark::State& state) {
  const auto scene = static_cast<bench::Scene>(state.range(0));
  const cv::Mat frame = bench::frame_of(
      scene, {static_cast<int>(state.range(1)), static_cast<int>(state.range(2))});
  RunScanner scanner;
  scanner.set_table(bench::maggic_table());
  const ScanArea area = whole_picture(frame.size());
  std::vector<Run> runs;
  for (auto _ : state) {
    scanner.scan(frame, area, nullptr, runs);
    benchmark::DoNotOptimize(runs.data());
  }
  state.SetLabel(bench::name_of(scene));
  state.counters["runs"] = static_cast<double>(runs.size());
  const auto seconds_per_item =
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["s/pixel"] =
      benchmark::Counter(static_cast<double>(frame.total()), seconds_per_item);
}

BENCHMARK(scan)
    ->ArgNames({"scene", "width", "height"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {320}, {240}})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {640}, {480}})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {1280}, {720}})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {1920}, {1080}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace maggic
