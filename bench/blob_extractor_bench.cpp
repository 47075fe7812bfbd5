/// From runs to blobs: nanoseconds a run over typical and worst pictures.

#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "bench_report.hpp"
#include "maggic/blob_extractor.hpp"
#include "maggic/pipeline.hpp"
#include "maggic/run_scanner.hpp"

namespace maggic {
namespace {

void extract(benchmark::State& state) {
  const auto scene = static_cast<bench::Scene>(state.range(0));
  const cv::Size size(static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  std::vector<Run> runs;
  RunScanner scanner;
  scanner.set_table(bench::maggic_table());
  scanner.scan(bench::frame_of(scene, size), whole_picture(size), nullptr, runs);
  BlobExtractor extractor;
  const BlobExtractor::Limits limits{.min_area_px = static_cast<double>(state.range(3)),
                                     .max_runs = static_cast<std::size_t>(state.range(4))};
  std::vector<Blob> blobs;
  for (auto _ : state) {
    extractor.extract(runs, limits, blobs);
    benchmark::DoNotOptimize(blobs.data());
  }
  state.SetLabel(bench::name_of(scene));
  state.counters["runs"] = static_cast<double>(runs.size());
  state.counters["blobs"] = static_cast<double>(blobs.size());
  bench::report_seconds_per(state, "s/run", runs.size());
}

constexpr std::int64_t kMaxRuns = BlobParameters().max_runs;
constexpr std::int64_t kNoCap = 100'000'000;

BENCHMARK(extract)
    ->ArgNames({"scene", "width", "height", "min_area_px", "max_runs"})
    ->ArgsProduct({{0, 2, 3, 4}, {640}, {480}, {1, 20}, {kMaxRuns, kNoCap}})
    ->ArgsProduct({{0, 2, 3, 4}, {1920}, {1080}, {1, 20}, {kMaxRuns, kNoCap}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace maggic
