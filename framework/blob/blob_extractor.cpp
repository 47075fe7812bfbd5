#include "maggic/blob_extractor.hpp"

#include <algorithm>
#include <limits>

namespace maggic {
namespace {

constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();

__extension__ using Wide = __int128;

// The root of `run`, halving the path on the way.
std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t run) {
  while (parent[run] != run) {
    parent[run] = parent[parent[run]];
    run = parent[run];
  }
  return run;
}

// The smaller index becomes the root, so that a parent never comes after its child.
void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  a = find_root(parent, a);
  b = find_root(parent, b);
  if (a < b) {
    parent[b] = a;
  } else {
    parent[a] = b;
  }
}

// mean(ab) - mean(a) mean(b), from exact integers: with plain doubles a small blob far from the
// origin would lose its digits.
double covariance(std::uint64_t count, std::uint64_t sum_ab, std::uint64_t sum_a,
                  std::uint64_t sum_b) {
  const Wide numerator = static_cast<Wide>(count) * sum_ab - static_cast<Wide>(sum_a) * sum_b;
  const auto n = static_cast<double>(count);
  return static_cast<double>(numerator) / (n * n);
}

}  // namespace

BlobExtractor::Sums::Sums(const Run& first)
    : min_x(first.begin),
      end_x(first.end),
      min_y(first.row),
      max_y(first.row),
      label(first.label) {}

void BlobExtractor::Sums::add(const Run& run) {
  const std::uint64_t begin = run.begin;
  const std::uint64_t end = run.end;
  const std::uint64_t row = run.row;
  // 0 + 1 + … + n-1 = n(n-1)/2 and 0² + 1² + … + (n-1)² = n(n-1)(2n-1)/6.
  const std::uint64_t below_begin = begin * (begin - 1) / 2;
  const std::uint64_t below_end = end * (end - 1) / 2;
  const std::uint64_t pixels = end - begin;
  const std::uint64_t sum_x = below_end - below_begin;
  const std::uint64_t sum_y = pixels * row;
  count += pixels;
  x += sum_x;
  y += sum_y;
  xx_times_3 += below_end * (2 * end - 1) - below_begin * (2 * begin - 1);
  yy += sum_y * row;
  xy += sum_x * row;
  min_x = std::min(min_x, run.begin);
  end_x = std::max(end_x, run.end);
  max_y = run.row;
}

Blob BlobExtractor::Sums::to_blob() const {
  constexpr double kPixelMoment = 1.0 / 12.0;
  const auto n = static_cast<double>(count);
  Blob blob;
  blob.label = label;
  blob.area_px = static_cast<std::int32_t>(
      std::min<std::uint64_t>(count, std::numeric_limits<std::int32_t>::max()));
  blob.centroid_px = {static_cast<double>(x) / n, static_cast<double>(y) / n};
  blob.bounds_px = {min_x, min_y, end_x - min_x, max_y - min_y + 1};
  blob.moment_xx_px2 = covariance(count, xx_times_3 / 3, x, x) + kPixelMoment;
  blob.moment_yy_px2 = covariance(count, yy, y, y) + kPixelMoment;
  blob.moment_xy_px2 = covariance(count, xy, x, y);
  return blob;
}

BlobExtractor::LeftOut BlobExtractor::extract(std::span<const Run> runs, const Limits& limits,
                                              std::vector<Blob>& blobs) {
  LeftOut left_out;
  runs = longest_runs_.keep(runs, limits.max_runs);
  left_out.runs_shorter_than_px = longest_runs_.shortest_px();
  join_touching(runs);
  add_up_areas(runs);
  left_out.blobs = choose(limits);
  sum_up(runs);
  blobs.clear();
  for (const Sums& sums : sums_) blobs.push_back(sums.to_blob());
  return left_out;
}

void BlobExtractor::join_touching(std::span<const Run> runs) {
  parent_.resize(runs.size());
  std::size_t above_begin = 0;  // The runs of the row above, if there are any.
  std::size_t above_end = 0;
  for (std::size_t i = 0; i < runs.size();) {
    const std::uint16_t row = runs[i].row;
    const std::size_t row_begin = i;
    const bool has_above = above_begin < above_end && runs[above_begin].row + 1 == row;
    std::size_t above = has_above ? above_begin : above_end;
    for (; i < runs.size() && runs[i].row == row; ++i) {
      const Run run = runs[i];
      parent_[i] = static_cast<std::uint32_t>(i);
      // Diagonal neighbours touch too, hence the ends included on both sides.
      while (above < above_end && runs[above].end < run.begin) ++above;
      for (std::size_t k = above; k < above_end && runs[k].begin <= run.end; ++k) {
        if (runs[k].label == run.label) {
          join(parent_, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(i));
        }
      }
    }
    above_begin = row_begin;
    above_end = i;
  }
}

// Makes every run's parent its region's first run. A parent comes before its child, so its own
// parent is that run already.
void BlobExtractor::add_up_areas(std::span<const Run> runs) {
  area_px_.resize(runs.size());
  first_runs_.resize(runs.size());
  std::size_t regions = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::uint32_t first = parent_[parent_[i]];
    parent_[i] = first;
    area_px_[i] = 0;
    area_px_[first] += static_cast<std::uint32_t>(runs[i].end - runs[i].begin);
    // Written first and kept or not afterwards: noise would mispredict a branch.
    first_runs_[regions] = first;
    regions += first == i ? 1 : 0;
  }
  first_runs_.resize(regions);
}

// Picks the regions that become blobs; returns how many fell to the cap.
std::size_t BlobExtractor::choose(const Limits& limits) {
  chosen_.clear();
  for (const std::uint32_t first : first_runs_) {
    const auto area_px = static_cast<double>(area_px_[first]);
    if (area_px >= limits.min_area_px && area_px <= limits.max_area_px) chosen_.push_back(first);
  }
  return chosen_.size() > limits.max_blobs ? keep_largest(limits.max_blobs) : 0;
}

// Of equally large ones the first. Returns how many were left out.
std::size_t BlobExtractor::keep_largest(std::size_t most) {
  const std::size_t left_out = chosen_.size() - most;
  chosen_areas_px_.clear();
  for (const std::uint32_t first : chosen_) chosen_areas_px_.push_back(area_px_[first]);
  const auto smallest = chosen_areas_px_.begin() + static_cast<std::ptrdiff_t>(left_out);
  std::nth_element(chosen_areas_px_.begin(), smallest, chosen_areas_px_.end());
  // Behind `smallest` lie those at least as large, and it may have equals on either side.
  const std::uint32_t smallest_px = *smallest;
  auto equals_wanted = std::count(smallest, chosen_areas_px_.end(), smallest_px);
  std::size_t kept = 0;
  for (const std::uint32_t first : chosen_) {
    const std::uint32_t area_px = area_px_[first];
    if (area_px < smallest_px || (area_px == smallest_px && equals_wanted-- <= 0)) continue;
    chosen_[kept++] = first;
  }
  chosen_.resize(kept);
  return left_out;
}

void BlobExtractor::sum_up(std::span<const Run> runs) {
  blob_of_.resize(runs.size());
  for (const std::uint32_t first : first_runs_) blob_of_[first] = kLeftOut;
  sums_.clear();
  for (const std::uint32_t first : chosen_) {
    blob_of_[first] = static_cast<std::uint32_t>(sums_.size());
    sums_.emplace_back(runs[first]);
  }
  // Only what becomes a blob is summed: on noise nearly everything falls to the area limits.
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::uint32_t blob = blob_of_[parent_[i]];
    if (blob != kLeftOut) sums_[blob].add(runs[i]);
  }
}

}  // namespace maggic
