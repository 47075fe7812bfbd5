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

void BlobExtractor::Sums::add(const Run& run) {
  const std::uint64_t n = run.end - run.begin;
  const std::uint64_t b = run.begin;
  const std::uint64_t steps = n * (n - 1) / 2;                 // 0 + 1 + … + n-1
  const std::uint64_t squares = n * (n - 1) * (2 * n - 1) / 6;  // 0² + 1² + … + (n-1)²
  const std::uint64_t row = run.row;
  const std::uint64_t sum_x = n * b + steps;
  count += n;
  x += sum_x;
  y += n * row;
  xx += n * b * b + 2 * b * steps + squares;
  yy += n * row * row;
  xy += row * sum_x;
  min_x = std::min(min_x, run.begin);
  max_x = std::max(max_x, static_cast<std::uint16_t>(run.end - 1));
  min_y = std::min(min_y, run.row);
  max_y = std::max(max_y, run.row);
  label = run.label;
}

Blob BlobExtractor::Sums::to_blob() const {
  constexpr double kPixelMoment = 1.0 / 12.0;
  const auto n = static_cast<double>(count);
  Blob blob;
  blob.label = label;
  blob.area_px = static_cast<std::int32_t>(
      std::min<std::uint64_t>(count, std::numeric_limits<std::int32_t>::max()));
  blob.centroid_px = {static_cast<double>(x) / n, static_cast<double>(y) / n};
  blob.bounds_px = {min_x, min_y, max_x - min_x + 1, max_y - min_y + 1};
  blob.moment_xx_px2 = covariance(count, xx, x, x) + kPixelMoment;
  blob.moment_yy_px2 = covariance(count, yy, y, y) + kPixelMoment;
  blob.moment_xy_px2 = covariance(count, xy, x, y);
  return blob;
}

std::size_t BlobExtractor::extract(std::span<const Run> runs, const Limits& limits,
                                   std::vector<Blob>& blobs) {
  blobs.clear();
  join_touching(runs);
  const std::size_t components = number_components(runs);
  const std::size_t left_out = choose(limits);

  // Only what becomes a blob is summed: on noise nearly everything falls to the area limits.
  blob_of_.assign(components, kLeftOut);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    blob_of_[chosen_[i]] = static_cast<std::uint32_t>(i);
  }
  sums_.assign(chosen_.size(), Sums{});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::uint32_t blob = blob_of_[parent_[i]];
    if (blob != kLeftOut) sums_[blob].add(runs[i]);
  }
  for (const Sums& sums : sums_) blobs.push_back(sums.to_blob());
  return left_out;
}

void BlobExtractor::join_touching(std::span<const Run> runs) {
  parent_.resize(runs.size());
  std::size_t above = 0;      // First run of the row above that may still touch.
  std::size_t above_end = 0;  // One past the runs of the row above.
  std::size_t row_begin = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    parent_[i] = static_cast<std::uint32_t>(i);
    if (run.row != runs[row_begin].row) {
      const bool adjacent = run.row == runs[row_begin].row + 1;
      above = adjacent ? row_begin : i;
      above_end = i;
      row_begin = i;
    }
    // Diagonal neighbours touch too, hence the ends included on both sides.
    while (above < above_end && runs[above].end < run.begin) ++above;
    for (std::size_t k = above; k < above_end && runs[k].begin <= run.end; ++k) {
      if (runs[k].label == run.label) {
        join(parent_, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(i));
      }
    }
  }
}

// Replaces every run's parent by its component's number, in the order of the first runs, and adds
// up the areas. A parent comes before its child, so it already holds the number.
std::size_t BlobExtractor::number_components(std::span<const Run> runs) {
  area_px_.clear();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool is_root = parent_[i] == i;
    parent_[i] = is_root ? static_cast<std::uint32_t>(area_px_.size()) : parent_[parent_[i]];
    if (is_root) area_px_.push_back(0);
    area_px_[parent_[i]] += static_cast<std::uint64_t>(runs[i].end - runs[i].begin);
  }
  return area_px_.size();
}

// Picks the components that become blobs; returns how many fell to the cap.
std::size_t BlobExtractor::choose(const Limits& limits) {
  chosen_.clear();
  for (std::size_t i = 0; i < area_px_.size(); ++i) {
    const auto area = static_cast<double>(area_px_[i]);
    if (area >= limits.min_area_px && area <= limits.max_area_px) {
      chosen_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (chosen_.size() <= limits.max_blobs) return 0;
  const std::size_t left_out = chosen_.size() - limits.max_blobs;
  const auto kept_end = chosen_.begin() + static_cast<std::ptrdiff_t>(limits.max_blobs);
  std::nth_element(chosen_.begin(), kept_end, chosen_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return area_px_[a] != area_px_[b] ? area_px_[a] > area_px_[b] : a < b;
  });
  chosen_.erase(kept_end, chosen_.end());
  std::ranges::sort(chosen_);
  return left_out;
}

}  // namespace maggic
