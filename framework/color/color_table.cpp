#include "maggic/color_table.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

namespace maggic {
namespace {

// Colours of one red and 32 greens: with the normalised planes and the labels 56 KiB, so a batch
// stays in a core's nearest caches.
constexpr std::size_t kBatch = 32 * 256;
constexpr std::size_t kBatches = ColorTable::kColors / kBatch;

// The planes of one batch. Blue is the same in all batches; green repeats with every red.
class BatchPlanes {
 public:
  BatchPlanes() : planes_(6 * kBatch) {
    for (std::size_t i = 0; i < kBatch; ++i) planes_[i] = static_cast<std::uint8_t>(i & 255);
  }

  ColorBatch colors(std::size_t batch) {
    const std::size_t first = batch * kBatch;
    std::uint8_t* green = planes_.data() + kBatch;
    std::uint8_t* red = planes_.data() + 2 * kBatch;
    for (std::size_t i = 0; i < kBatch; i += 256) {
      std::fill_n(green + i, 256, static_cast<std::uint8_t>((first + i) >> 8 & 255));
    }
    std::fill_n(red, kBatch, static_cast<std::uint8_t>(first >> 16));
    return {plane(0), plane(1), plane(2)};
  }

  MutableColorBatch normalized() { return {plane(3), plane(4), plane(5)}; }

 private:
  std::span<std::uint8_t> plane(std::size_t index) {
    return {planes_.data() + index * kBatch, kBatch};
  }

  std::vector<std::uint8_t> planes_;
};

void refuse_labels_beyond(std::size_t palette_size, std::span<const Label> labels,
                          std::size_t first_color) {
  const auto highest = std::ranges::max_element(labels);
  const std::size_t color = first_color + static_cast<std::size_t>(highest - labels.begin());
  throw std::logic_error(fmt::format(
      "the segmenter gave colour B {} G {} R {} the label {}; expected a label below the palette's "
      "size {}",
      color & 255, color >> 8 & 255, color >> 16, *highest, palette_size));
}

Label highest_label(std::span<const Label> labels) {
  Label highest = 0;
  for (const Label label : labels) highest = label > highest ? label : highest;
  return highest;
}

}  // namespace

ColorTable::ColorTable() : labels_(kColors, kBackground) {}

ColorTable ColorTable::compile(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                               std::size_t palette_size, unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  ColorTable table;
  std::atomic<std::size_t> next_batch{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;

  const auto work = [&] {
    try {
      BatchPlanes planes;
      const MutableColorBatch normalized = planes.normalized();
      for (std::size_t batch = next_batch++; batch < kBatches; batch = next_batch++) {
        const ColorBatch colors = planes.colors(batch);
        const std::span<Label> labels(table.labels_.data() + batch * kBatch, kBatch);
        normalizer.normalize(colors, normalized);
        segmenter.segment(colors, normalized.as_const(), labels);
        if (highest_label(labels) >= palette_size) {
          refuse_labels_beyond(palette_size, labels, batch * kBatch);
        }
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next_batch = kBatches;  // The others stop after their batch.
    }
  };

  {
    std::vector<std::jthread> workers;
    for (unsigned i = 1; i < threads; ++i) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return table;
}

}  // namespace maggic
