#pragma once
/// One line on how a run is going.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "maggic/frame_result.hpp"
#include "maggic/runner.hpp"

namespace maggic::app {

struct Quantiles {
  double p50_ms = 0.0;
  double p99_ms = 0.0;
};

/// State of a run at one moment.
struct LiveState {
  std::uint64_t processed = 0;
  std::uint64_t dropped = 0;
  std::uint64_t skipped = 0;
  std::uint64_t failed = 0;
  std::optional<std::uint64_t> total;      ///< Frames the source will give, when known.
  std::optional<std::uint64_t> max_taken;  ///< Frames the run will take, dropped ones not counted.
  double elapsed_s = 0.0;
  double frames_per_second = 0.0;  ///< Lately.
  std::size_t robots = 0;          ///< In the latest frame, predicted ones included.
  bool ball = false;
  Quantiles frame_path;
  std::array<Quantiles, static_cast<std::size_t>(Step::kCount)> steps;
};

Quantiles quantiles_of(const DurationHistogram& histogram);

/// "[##----]  40% ETA 0:12  148 fps  6 robots+ball  0 dropped  p50/p99 0.56/1.07 ms  segment …":
/// as much as fits into `width` columns, the most telling parts first; from 80 columns on the
/// whole frame path's times, from 150 on those of every step. Before the first frame it says that
/// it waits, and for how long. ASCII only, never wider.
std::string live_line(const LiveState& state, int width);

}  // namespace maggic::app
