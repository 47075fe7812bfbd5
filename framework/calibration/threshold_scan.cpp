#include "calibration/threshold_scan.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "calibration/plateau.hpp"

namespace maggic::calibration {
namespace {

constexpr std::array<int, 17> kLadder{5,  7,  9,  12, 15, 19,  24,  30, 37,
                                      46, 56, 68, 82, 98, 117, 140, 165};

// Noise breaks into so many pieces that nothing can be learnt from such a level.
constexpr std::size_t kMaxPatches = 1500;
// Scales of robots agree so far; perspective and a stretched picture spread them.
constexpr double kScaleTolerance = 0.25;
constexpr double kBinWidth = 0.06;          // of the vote, in log scale
constexpr double kPlateauTolerance = 0.06;  // of a level's worth
constexpr double kTagSizeRatio = 1.8;
constexpr double kLeftOverCost = 0.3;

/// Runs `work(0 … count - 1)` over the cores. @throws what a call threw first.
template <class Work>
void in_parallel(std::size_t count, Work work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work_on = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t i = 1; i < std::min(cores, count); ++i) helpers.emplace_back(work_on);
    work_on();
  }
  if (failure) std::rethrow_exception(failure);
}

/// A tag keeps its spread at every threshold, while noise is always just above it: so weighed, tags
/// that come up again and again outvote any number of specks at the lowest thresholds.
double palest_of(const FramePatches& frame, const PatternCandidate& candidate) {
  int palest = 255;
  for (const int p : candidate.patches) {
    palest = std::min(palest, frame.patches[static_cast<std::size_t>(p)].median_spread);
  }
  return palest;
}

/// The scale most patterns of all levels agree on; 0 when there are none.
double vote_scale(const std::vector<ThresholdLevel>& levels, const ScaleRange& scales) {
  const auto bins = static_cast<std::size_t>(
      std::log(scales.max_mm_per_px / scales.min_mm_per_px) / kBinWidth + 1.0);
  std::vector<double> votes(bins + 2, 0.0);
  const auto bin_of = [&](double mm_per_px) {
    return static_cast<std::size_t>(std::log(mm_per_px / scales.min_mm_per_px) / kBinWidth) + 1;
  };
  for (const ThresholdLevel& level : levels) {
    for (const FramePatches& frame : level.frames) {
      for (const auto* candidate : choose_apart(frame.candidates, frame.patches.size())) {
        const double scale = candidate->mm_per_px;
        if (scale < scales.min_mm_per_px || scale > scales.max_mm_per_px) continue;
        votes[std::min(bin_of(scale), bins)] +=
            (1.0 - candidate->misfit) * palest_of(frame, *candidate);
      }
    }
  }
  double best = 0.0;
  double scale = 0.0;
  for (std::size_t i = 1; i <= bins; ++i) {
    const double here = votes[i - 1] + votes[i] + votes[i + 1];
    if (here <= best) continue;
    best = here;
    const double middle = static_cast<double>(i) - 0.5 + (votes[i + 1] - votes[i - 1]) / here;
    scale = scales.min_mm_per_px * std::exp(middle * kBinWidth);
  }
  return scale;
}

void add_distances(const FramePatches& frame, std::span<const TagLayout> layouts, double scale,
                   std::vector<KnownDistance>& distances) {
  for (const auto* candidate : choose_apart(frame.candidates, frame.patches.size())) {
    if (std::abs(std::log(candidate->mm_per_px / scale)) > kScaleTolerance) continue;
    const TagLayout& layout = layouts[static_cast<std::size_t>(candidate->layout)];
    for (std::size_t i = 0; i < candidate->patches.size(); ++i) {
      for (std::size_t j = i + 1; j < candidate->patches.size(); ++j) {
        const auto at = [&](std::size_t k) {
          return frame.patches[static_cast<std::size_t>(candidate->patches[k])].centroid_px;
        };
        distances.push_back(
            {at(i) - at(j), cv::norm(layout.patches[i].center_mm - layout.patches[j].center_mm)});
      }
    }
  }
}

/// Patterns that share no patch, less something for what is as large as a tag and part of none.
double worth_of(const FramePatches& frame, std::span<const TagLayout> layouts,
                const TagMetric& metric) {
  const auto chosen = choose_apart(frame.candidates, frame.patches.size());
  std::size_t used = 0;
  for (const PatternCandidate* candidate : chosen) used += candidate->patches.size();
  const auto tag_sized = std::ranges::count_if(frame.patches, [&](const Patch& patch) {
    return std::ranges::any_of(layouts, [&](const TagLayout& layout) {
      return std::ranges::any_of(layout.patches, [&](const TagPatch& tag) {
        const double ratio = patch.area_px * metric.pixel_mm2() / tag.expected_area_mm2();
        return ratio > 1.0 / kTagSizeRatio && ratio < kTagSizeRatio;
      });
    });
  });
  const double left_over = static_cast<double>(tag_sized) - static_cast<double>(used);
  return static_cast<double>(chosen.size()) - kLeftOverCost * std::max(0.0, left_over);
}

}  // namespace

std::span<const int> threshold_ladder() { return kLadder; }

std::vector<FramePatches> find_candidates(std::span<const ChromaFrame> frames, int gray_threshold,
                                          std::span<const TagLayout> layouts,
                                          const TagMetric& metric) {
  std::vector<FramePatches> found(frames.size());
  in_parallel(frames.size(), [&](std::size_t f) {
    found[f].patches = find_patches(frames[f], gray_threshold);
    if (found[f].patches.size() > kMaxPatches) found[f].patches.clear();
    found[f].candidates = list_candidates(found[f].patches, layouts, metric);
  });
  return found;
}

ThresholdScan scan_thresholds(std::span<const ChromaFrame> frames, std::span<const int> thresholds,
                              std::span<const TagLayout> layouts, const ScaleRange& scales) {
  ThresholdScan scan;
  for (const int threshold : thresholds) {
    scan.levels.push_back({threshold, std::vector<FramePatches>(frames.size()), 0.0});
  }
  in_parallel(scan.levels.size() * frames.size(), [&](std::size_t i) {
    const std::size_t f = i % frames.size();
    ThresholdLevel& level = scan.levels[i / frames.size()];
    FramePatches& frame = level.frames[f];
    frame.patches = find_patches(frames[f], level.gray_threshold);
    if (frame.patches.size() > kMaxPatches) frame.patches.clear();
    frame.candidates = list_candidates(frame.patches, layouts, std::nullopt);
  });
  const double scale = vote_scale(scan.levels, scales);
  if (scale <= 0.0) return scan;
  std::vector<KnownDistance> distances;
  for (const ThresholdLevel& level : scan.levels) {
    for (const FramePatches& frame : level.frames) add_distances(frame, layouts, scale, distances);
  }
  if (distances.empty()) return scan;
  scan.metric = fit_metric(distances);
  for (ThresholdLevel& level : scan.levels) {
    for (FramePatches& frame : level.frames) {
      frame.candidates = list_candidates(frame.patches, layouts, scan.metric);
      level.worth += worth_of(frame, layouts, *scan.metric) / static_cast<double>(frames.size());
    }
  }
  std::vector<double> worth;
  for (const ThresholdLevel& level : scan.levels) worth.push_back(level.worth);
  scan.best = find_plateau(worth, kPlateauTolerance).middle();
  return scan;
}

}  // namespace maggic::calibration
