#include <future>
#include <latch>
#include <vector>

#include "maggic/speed_measurement.hpp"
#include "measurement/samples.hpp"
#include "measurement/warm_up.hpp"

namespace maggic {
namespace {

constexpr int kRounds = 5;

}  // namespace

double measure_throughput(std::span<Pipeline* const> pipelines, const FrameStore& store,
                          std::uint64_t frames) {
  std::vector<FrameResult> results(pipelines.size());
  for (std::size_t k = 0; k < pipelines.size(); ++k) warm_up(*pipelines[k], store, results[k]);

  Samples rounds(kRounds);
  for (int round = 0; round < kRounds; ++round) {
    std::latch start(static_cast<std::ptrdiff_t>(pipelines.size()) + 1);
    // Each from another place in the store, so that none finds what another one fetched.
    const auto work = [&](std::size_t k) {
      const std::uint64_t first = kWarmUpFrames + k * store.size() / pipelines.size();
      start.arrive_and_wait();
      for (std::uint64_t i = 0; i < frames; ++i) {
        store.get(first + i, results[k].frame);
        pipelines[k]->process(results[k]);
      }
    };
    std::vector<std::future<void>> workers;
    for (std::size_t k = 0; k < pipelines.size(); ++k) {
      workers.push_back(std::async(std::launch::async, work, k));
    }
    start.arrive_and_wait();
    rounds.time([&] {
      for (std::future<void>& worker : workers) worker.get();
    });
  }
  const double seconds = std::chrono::duration<double>(rounds.figures().p50).count();
  return static_cast<double>(frames * pipelines.size()) / seconds;
}

}  // namespace maggic
