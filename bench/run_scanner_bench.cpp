/// From pixels to runs: nanoseconds a pixel over typical and worst pictures.

#include <vector>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "bench_report.hpp"
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
  bench::report_seconds_per(state, "s/pixel", frame.total());
}

BENCHMARK(scan)->Apply(bench::every_scene_and_size);

}  // namespace
}  // namespace maggic
