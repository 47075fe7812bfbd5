#pragma once
/// Takes the time of one thing again and again.

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

#include "maggic/duration_figures.hpp"

namespace maggic {

class Samples {
 public:
  explicit Samples(std::size_t expected) { times_.reserve(expected); }

  void add(std::chrono::nanoseconds time) { times_.push_back(time); }

  template <class Work>
  void time(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    std::forward<Work>(work)();
    add(std::chrono::steady_clock::now() - start);
  }

  DurationFigures figures() { return figures_of(times_); }

 private:
  std::vector<std::chrono::nanoseconds> times_;
};

}  // namespace maggic
