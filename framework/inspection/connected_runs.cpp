#include "inspection/connected_runs.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace maggic {
namespace {

/// Index of the first run that does not end before (row, column).
std::size_t first_from(std::span<const Run> runs, int row, int column) {
  const auto found = std::ranges::lower_bound(
      runs, std::tuple(row, column), {},
      [](const Run& run) { return std::tuple(int{run.row}, run.end - 1); });
  return static_cast<std::size_t>(found - runs.begin());
}

}  // namespace

const Run* run_at(std::span<const Run> runs, cv::Point pixel_px) {
  const std::size_t i = first_from(runs, pixel_px.y, pixel_px.x);
  const bool holds = i < runs.size() && runs[i].row == pixel_px.y && runs[i].begin <= pixel_px.x;
  return holds ? &runs[i] : nullptr;
}

std::vector<Run> connected_runs(std::span<const Run> runs, cv::Point pixel_px) {
  const Run* start = run_at(runs, pixel_px);
  if (start == nullptr) return {};
  std::vector<char> taken(runs.size(), 0);
  std::vector<std::size_t> open{static_cast<std::size_t>(start - runs.data())};
  taken[open.front()] = 1;
  while (!open.empty()) {
    const Run run = runs[open.back()];
    open.pop_back();
    for (const int row : {run.row - 1, run.row + 1}) {
      // Corners count as touching, so a neighbour may start one column past the run's end.
      for (std::size_t i = first_from(runs, row, run.begin - 1);
           i < runs.size() && runs[i].row == row && runs[i].begin <= run.end; ++i) {
        if (taken[i] != 0 || runs[i].label != run.label) continue;
        taken[i] = 1;
        open.push_back(i);
      }
    }
  }
  std::vector<Run> region;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (taken[i] != 0) region.push_back(runs[i]);
  }
  return region;
}

}  // namespace maggic
