/// From blobs to detections: a frame's cost over robots, tag patterns and stray blobs.
///
/// The counters are of the single frames, in seconds; the time is their mean.

#include <chrono>
#include <vector>

#include <benchmark/benchmark.h>

#include "maggic/duration_figures.hpp"
#include "maggic/testing.hpp"
#include "maggic/tracking_engine.hpp"
#include "measurement/cache_eviction.hpp"
#include "tracking/crowd_for_tests.hpp"

namespace maggic {
namespace {

using tracking::Crowd;
using tracking::Scene;

constexpr std::chrono::nanoseconds kPeriod{16'666'667};

struct Pattern {
  const char* name;
  TagLayout layout;
};

const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> all = {{"two_tag", tracking::two_tags()},
                                           {"three_tag", tracking::three_tags()},
                                           {"diagonal", tracking::diagonal_squares()}};
  return all;
}

class FrameTimes {
 public:
  template <class Work>
  void measure(benchmark::State& state, Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::nanoseconds time = std::chrono::steady_clock::now() - start;
    times_.push_back(time);
    state.SetIterationTime(std::chrono::duration<double>(time).count());
  }

  void report(benchmark::State& state) {
    using Seconds = std::chrono::duration<double>;
    const DurationFigures figures = figures_of(times_);
    state.counters["p50"] = Seconds(figures.p50).count();
    state.counters["p99"] = Seconds(figures.p99).count();
  }

 private:
  std::vector<std::chrono::nanoseconds> times_;
};

/// @param before_frame runs before every frame, unmeasured.
template <class Before>
void track_crowd(benchmark::State& state, const Crowd& crowd, const char* pattern,
                 Before before_frame) {
  const std::vector<Scene> scenes = scenes_of(crowd);
  testing::RecordingReporter reporter;
  TrackingEngine engine(tracking::standard_parameters(), {crowd.layout}, &reporter);
  Detections out;
  FrameTimes times;
  std::uint64_t frame = 0;
  std::uint64_t most_blobs = 0;
  const auto input = [&]() -> TrackerInput {
    const Scene& scene = scenes[frame % scenes.size()];
    most_blobs = std::max<std::uint64_t>(most_blobs, scene.blobs().size());
    const auto sequence = frame++;
    return {sequence, sequence * kPeriod, scene.blobs(), scene.field()};
  };
  for (int i = 0; i < Crowd::kFrames; ++i) engine.track(input(), out);
  for (auto _ : state) {
    const TrackerInput next = input();
    before_frame();
    times.measure(state, [&] { engine.track(next, out); });
  }
  times.report(state);
  state.SetLabel(pattern);
  state.counters["blobs"] = static_cast<double>(most_blobs);
  state.counters["found"] = static_cast<double>(out.robots.size());
  state.counters["cut_short"] =
      static_cast<double>(reporter.messages().size()) / static_cast<double>(frame);
}

Crowd crowd_of(const benchmark::State& state) {
  return {.layout = patterns()[static_cast<std::size_t>(state.range(0))].layout,
          .robots = static_cast<int>(state.range(1)),
          .strays = static_cast<int>(state.range(2)),
          .heaped = state.range(3) != 0,
          .moving = state.range(4) != 0};
}

const char* pattern_of(const benchmark::State& state) {
  return patterns()[static_cast<std::size_t>(state.range(0))].name;
}

void track(benchmark::State& state) {
  track_crowd(state, crowd_of(state), pattern_of(state), [] {});
}

void track_cold(benchmark::State& state) {
  CacheEvictor caches;
  track_crowd(state, crowd_of(state), pattern_of(state), [&] { caches.evict(); });
}

BENCHMARK(track)
    ->ArgNames({"pattern", "robots", "strays", "heaped", "moving"})
    ->ArgsProduct({{0, 1, 2}, {6, 10, 22}, {0}, {0}, {0, 1}})
    ->ArgsProduct({{0, 1, 2}, {6, 10, 22}, {100, 300, 1000}, {0, 1}, {0, 1}})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

BENCHMARK(track_cold)
    ->ArgNames({"pattern", "robots", "strays", "heaped", "moving"})
    ->ArgsProduct({{0, 1, 2}, {6, 22}, {0, 300}, {0}, {1}})
    ->UseManualTime()
    ->Iterations(60)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace maggic
