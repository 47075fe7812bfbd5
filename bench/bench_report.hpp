#pragma once
/// What the frame-path benchmarks have in common: the cases, and the cost of one item.

#include <cstddef>

#include <benchmark/benchmark.h>

namespace maggic::bench {

/// Every Scene at every usual picture size, as the arguments scene, width and height.
inline void every_scene_and_size(benchmark::internal::Benchmark* cases) {
  cases->ArgNames({"scene", "width", "height"})
      ->ArgsProduct({{0, 1, 2, 3, 4}, {320}, {240}})
      ->ArgsProduct({{0, 1, 2, 3, 4}, {640}, {480}})
      ->ArgsProduct({{0, 1, 2, 3, 4}, {1280}, {720}})
      ->ArgsProduct({{0, 1, 2, 3, 4}, {1920}, {1080}})
      ->Unit(benchmark::kMicrosecond);
}

/// Reports, under `name`, how long one of the `items` of an iteration takes.
inline void report_seconds_per(benchmark::State& state, const char* name, std::size_t items) {
  state.counters[name] = benchmark::Counter(
      static_cast<double>(items),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace maggic::bench
