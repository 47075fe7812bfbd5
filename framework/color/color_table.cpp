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

constexpr std::size_t kSide = ColorTable::kBlockSide;

// Blocks that differ in blue alone: with the normalised planes and the labels 112 KiB, so a batch
// stays in a core's second cache.
constexpr std::size_t kBlocksPerBatch = 32;
constexpr std::size_t kBatch = kBlocksPerBatch * ColorTable::kColorsPerBlock;
constexpr std::size_t kBatches = ColorTable::kBlocks / kBlocksPerBatch;

// The planes of one batch, colours in the table's order. Blue is the same in all batches.
class BatchPlanes {
 public:
  BatchPlanes() : planes_(6 * kBatch) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      planes_[i] = static_cast<std::uint8_t>(i / ColorTable::kColorsPerBlock * kSide + i % kSide);
    }
  }

  ColorBatch colors(std::size_t batch) {
    std::uint8_t* green = planes_.data() + kBatch;
    std::uint8_t* red = planes_.data() + 2 * kBatch;
    for (std::size_t i = 0; i < kBatch; ++i) {
      green[i] = static_cast<std::uint8_t>(batch % 32 * kSide + i / kSide % kSide);
      red[i] = static_cast<std::uint8_t>(batch / 32 * kSide + i / (kSide * kSide) % kSide);
    }
    return {plane(0), plane(1), plane(2)};
  }

  MutableColorBatch normalized() { return {plane(3), plane(4), plane(5)}; }

 private:
  std::span<std::uint8_t> plane(std::size_t index) {
    return {planes_.data() + index * kBatch, kBatch};
  }

  std::vector<std::uint8_t> planes_;
};

[[noreturn]] void refuse_label_beyond(std::size_t palette_size, std::span<const Label> labels,
                                      const ColorBatch& colors) {
  const auto i = static_cast<std::size_t>(std::ranges::max_element(labels) - labels.begin());
  throw std::logic_error(fmt::format(
      "the segmenter gave colour B {} G {} R {} the label {}; expected a label below the palette's "
      "size {}",
      colors.b[i], colors.g[i], colors.r[i], labels[i], palette_size));
}

Label highest_label(std::span<const Label> labels) {
  Label highest = 0;
  for (const Label label : labels) highest = label > highest ? label : highest;
  return highest;
}

bool is_one_label(const Label* block) {
  return std::all_of(block, block + ColorTable::kColorsPerBlock,
                     [&](Label label) { return label == block[0]; });
}

}  // namespace

ColorTable::ColorTable() : block_ids_(kBlocks, 0), block_labels_(kColorsPerBlock, kBackground) {}

ColorTable ColorTable::compile(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                               std::size_t palette_size, unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Label> all_labels(kColors);
  std::atomic<std::size_t> next_batch{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;

  const auto work = [&] {
    try {
      BatchPlanes planes;
      const MutableColorBatch normalized = planes.normalized();
      for (std::size_t batch = next_batch++; batch < kBatches; batch = next_batch++) {
        const ColorBatch colors = planes.colors(batch);
        const std::span<Label> labels(all_labels.data() + batch * kBatch, kBatch);
        normalizer.normalize(colors, normalized);
        segmenter.segment(colors, normalized.as_const(), labels);
        if (highest_label(labels) >= palette_size) {
          refuse_label_beyond(palette_size, labels, colors);
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

  ColorTable table;
  table.uniform_blocks_ = palette_size;
  table.block_labels_.resize(palette_size * kColorsPerBlock);
  for (std::size_t label = 0; label < palette_size; ++label) {
    std::fill_n(table.block_labels_.data() + label * kColorsPerBlock, kColorsPerBlock,
                static_cast<Label>(label));
  }
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const Label* labels = all_labels.data() + block * kColorsPerBlock;
    if (is_one_label(labels)) {
      table.block_ids_[block] = labels[0];
    } else {
      table.block_ids_[block] =
          static_cast<std::uint16_t>(table.block_labels_.size() / kColorsPerBlock);
      table.block_labels_.insert(table.block_labels_.end(), labels, labels + kColorsPerBlock);
    }
  }
  return table;
}

bool operator==(const ColorTable& a, const ColorTable& b) {
  for (std::size_t block = 0; block < ColorTable::kBlocks; ++block) {
    if (!std::equal(a.block(block), a.block(block) + ColorTable::kColorsPerBlock, b.block(block))) {
      return false;
    }
  }
  return true;
}

}  // namespace maggic
