#include <algorithm>
#include <chrono>
#include <future>
#include <latch>
#include <vector>

#include "maggic/speed_measurement.hpp"
#include "measurement/samples.hpp"
#include "measurement/warm_up.hpp"

namespace maggic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 5;

/// When one pipeline was at work.
struct Shift {
  Clock::time_point began;
  Clock::time_point ended;
};

std::chrono::nanoseconds from_first_to_last(const std::vector<Shift>& shifts) {
  const auto began = std::ranges::min(shifts, {}, &Shift::began).began;
  const auto ended = std::ranges::max(shifts, {}, &Shift::ended).ended;
  return ended - began;
}

}  // namespace

double measure_throughput(std::span<Pipeline* const> pipelines, const FrameStore& store,
                          std::uint64_t frames) {
  std::vector<FrameResult> results(pipelines.size());
  for (std::size_t k = 0; k < pipelines.size(); ++k) warm_up(*pipelines[k], store, results[k]);

  Samples rounds(kRounds);
  for (int round = 0; round < kRounds; ++round) {
    std::latch start(static_cast<std::ptrdiff_t>(pipelines.size()));
    // Each from another place in the store, so that none finds what another one fetched.
    const auto work = [&](std::size_t k) {
      const std::uint64_t first = kWarmUpFrames + k * store.size() / pipelines.size();
      start.arrive_and_wait();
      const Clock::time_point began = Clock::now();
      for (std::uint64_t i = 0; i < frames; ++i) {
        store.get(first + i, results[k].frame);
        pipelines[k]->process(results[k]);
      }
      return Shift{began, Clock::now()};
    };
    std::vector<std::future<Shift>> workers;
    try {
      for (std::size_t k = 0; k < pipelines.size(); ++k) {
        workers.push_back(std::async(std::launch::async, work, k));
      }
    } catch (...) {
      // The threads that did start wait for the others, and leaving waits for them.
      start.count_down(static_cast<std::ptrdiff_t>(pipelines.size() - workers.size()));
      throw;
    }
    std::vector<Shift> shifts;
    shifts.reserve(workers.size());
    for (std::future<Shift>& worker : workers) shifts.push_back(worker.get());
    rounds.add(from_first_to_last(shifts));
  }
  const double seconds = std::chrono::duration<double>(rounds.figures().p50).count();
  return static_cast<double>(frames * pipelines.size()) / seconds;
}

}  // namespace maggic
