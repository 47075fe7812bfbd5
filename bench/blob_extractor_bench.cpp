/// From runs to blobs: nanoseconds a run over typical and worst pictures.

#include <vector>

#include <benchmark/benchmark.h>

#include "bench_frames.hpp"
#include "maggic/blob_extractor.hpp"
#include "maggic/run_scanner.hpp"

namespace maggic {
namespace {

void extract(benchmark::State& state) {
  const auto scene = static_cast<bench::Scene>(state.range(0));
  std::vector<Run> runs;
  RunScanner scanner;
  scanner.set_table(bench::maggic_table());
  scanner.scan(bench::frame_of(scene, {640, 480}), whole_picture({640, 480}), nullptr, runs);
  BlobExtractor extractor;
  const BlobExtractor::Limits limits{.min_area_px = static_cast<double>(state.range(1))};
  std::vector<Blob> blobs;
  for (auto _ : state) {
    extractor.extract(runs, limits, blobs);
    benchmark::DoNotOptimize(blobs.data());
  }
  state.SetLabel(bench::name_of(scene));
  state.counters["runs"] = static_cast<double>(runs.size());
  state.counters["blobs"] = static_cast<double>(blobs.size());
  const auto seconds_per_item =
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["s/run"] =
      benchmark::Counter(static_cast<double>(runs.size()), seconds_per_item);
}

BENCHMARK(extract)
    ->ArgNames({"scene", "min_area"})
    ->ArgsProduct({{0, 2, 3, 4}, {1, 20}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace maggic
