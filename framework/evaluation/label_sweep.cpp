#include "maggic/label_sweep.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace maggic {
namespace {

/// Colours as the stages read them.
struct Planes {
  std::vector<std::uint8_t> b, g, r;

  explicit Planes(std::size_t size) : b(size), g(size), r(size) {}
  ColorBatch batch() const { return {b, g, r}; }
  MutableColorBatch writable() { return {b, g, r}; }
};

Planes planes_of(std::span<const LabelledColors::Entry> entries) {
  Planes planes(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    planes.r[i] = static_cast<std::uint8_t>(entries[i].key >> 24);
    planes.g[i] = static_cast<std::uint8_t>(entries[i].key >> 16);
    planes.b[i] = static_cast<std::uint8_t>(entries[i].key >> 8);
  }
  return planes;
}

void check_pair(const cv::Mat& bgr, const cv::Mat& labels, std::size_t palette_size) {
  if (bgr.type() != CV_8UC3 || labels.type() != CV_8UC1) {
    throw std::invalid_argument("expected a picture of three and labels of one 8-bit channel");
  }
  if (bgr.size() != labels.size()) {
    throw std::invalid_argument(fmt::format("the labels are {} x {}, the picture is {} x {}",
                                            labels.cols, labels.rows, bgr.cols, bgr.rows));
  }
  for (int y = 0; y < labels.rows; ++y) {
    const auto* row = labels.ptr<Label>(y);
    const auto* unknown =
        std::find_if(row, row + labels.cols, [&](Label label) { return label >= palette_size; });
    if (unknown == row + labels.cols) continue;
    throw std::invalid_argument(fmt::format("label {} at x {}, y {}, expected less than {}",
                                            *unknown, unknown - row, y, palette_size));
  }
}

}  // namespace

void LabelledColors::add(const cv::Mat& bgr, const cv::Mat& labels) {
  check_pair(bgr, labels, pixels_.size());
  std::vector<std::uint32_t> keys;
  keys.reserve(bgr.total());
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* pixel = bgr.ptr<cv::Vec3b>(y);
    const auto* label = labels.ptr<Label>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      keys.push_back(std::uint32_t{pixel[x][2]} << 24 | std::uint32_t{pixel[x][1]} << 16 |
                     std::uint32_t{pixel[x][0]} << 8 | label[x]);
      ++pixels_[label[x]];
    }
  }
  std::ranges::sort(keys);
  std::vector<Entry> merged;
  merged.reserve(entries_.size() + keys.size() / 4);
  auto old = entries_.begin();
  for (auto key = keys.begin(); key != keys.end();) {
    const auto next = std::find_if(key, keys.end(), [&](std::uint32_t k) { return k != *key; });
    const auto count = static_cast<std::uint64_t>(next - key);
    while (old != entries_.end() && old->key < *key) merged.push_back(*old++);
    const bool is_known = old != entries_.end() && old->key == *key;
    merged.push_back({*key, count + (is_known ? (old++)->count : 0)});
    key = next;
  }
  merged.insert(merged.end(), old, entries_.end());
  entries_ = std::move(merged);
}

LabelSweep::LabelSweep(std::vector<std::uint64_t> pixels)
    : pixels_(std::move(pixels)), right_(pixels_.size()) {
  for (auto& by_threshold : right_) by_threshold.fill(0);
}

double LabelSweep::share(Label label, std::size_t threshold) const {
  const std::uint64_t all = pixels_.at(label);
  if (all == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(right_.at(label).at(threshold)) / static_cast<double>(all);
}

std::pair<double, Label> LabelSweep::smallest_share(std::size_t threshold) const {
  std::pair<double, Label> smallest{std::numeric_limits<double>::infinity(), kBackground};
  for (std::size_t label = 0; label < pixels_.size(); ++label) {
    const double own = share(static_cast<Label>(label), threshold);
    if (own < smallest.first) smallest = {own, static_cast<Label>(label)};
  }
  return smallest;
}

std::size_t LabelSweep::best_threshold() const {
  std::size_t best = 0;
  for (std::size_t t = 1; t < kThresholds; ++t) {
    if (smallest_share(t).first > smallest_share(best).first) best = t;
  }
  return best;
}

std::optional<LabelSweep::Range> LabelSweep::usable(double share) const {
  std::optional<Range> widest;
  std::optional<Range> current;
  for (std::size_t t = 0; t < kThresholds; ++t) {
    if (smallest_share(t).first < share) {
      current.reset();
      continue;
    }
    current = Range{current ? current->first : t, t};
    if (!widest || current->width() > widest->width()) widest = current;
  }
  return widest;
}

std::vector<LabelSweep> sweep_gray_threshold(
    const LabelledColors& colors, std::span<const ColorNormalizer* const> normalizers,
    const std::function<const ColorSegmenter&(int threshold)>& segmenter_with) {
  std::vector<std::uint64_t> pixels;
  for (std::size_t label = 0; label < colors.palette_size(); ++label) {
    pixels.push_back(colors.pixels(static_cast<Label>(label)));
  }
  std::vector<LabelSweep> sweeps(normalizers.size(), LabelSweep(pixels));

  const std::span<const LabelledColors::Entry> entries = colors.entries();
  const Planes original = planes_of(entries);
  std::vector<Planes> normalized(normalizers.size(), Planes(entries.size()));
  for (std::size_t n = 0; n < normalizers.size(); ++n) {
    normalizers[n]->normalize(original.batch(), normalized[n].writable());
  }
  std::vector<Label> found(entries.size());
  for (std::size_t t = 0; t < LabelSweep::kThresholds; ++t) {
    const ColorSegmenter& segmenter = segmenter_with(static_cast<int>(t));
    for (std::size_t n = 0; n < normalizers.size(); ++n) {
      segmenter.segment(original.batch(), normalized[n].batch(), found);
      std::vector<std::uint64_t> right(pixels.size(), 0);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto label = static_cast<Label>(entries[i].key);
        if (found[i] == label) right[label] += entries[i].count;
      }
      for (std::size_t label = 0; label < right.size(); ++label) {
        sweeps[n].count_right(static_cast<Label>(label), t, right[label]);
      }
    }
  }
  return sweeps;
}

}  // namespace maggic
