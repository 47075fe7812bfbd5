#include "color/table_compiler.hpp"

#include <algorithm>
#include <cstring>

#include "color/shared_tasks.hpp"

namespace maggic {
namespace {

constexpr std::uint8_t kBlockSide = ColorTable::kBlockSide;
constexpr std::size_t kBlocksPerSide = 32;
constexpr unsigned kOctants = 8;

// Where the walk begins. Larger cells are hardly ever of one label.
constexpr std::uint8_t kLargestSide = 32;
constexpr std::size_t kLargestCells = 8 * 8 * 8;

// 4096 colours a batch: the planes, 24 KiB, stay in a core's first cache.
constexpr std::size_t kBlocksPerTask = 8;

constexpr std::uint16_t kUndecided = 0xFFFF;

bool is_one_label(const Label* block) {
  return std::memcmp(block, block + 1, ColorTable::kColorsPerBlock - 1) == 0;
}

}  // namespace

TableCompiler::TableCompiler(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                             std::size_t palette_size, unsigned threads)
    : block_ids(ColorTable::kBlocks),
      uniform_blocks(std::min<std::size_t>(palette_size, 256)),
      normalizer_(normalizer),
      segmenter_(segmenter),
      palette_size_(palette_size),
      threads_(threads) {}

void TableCompiler::run() {
  share_out(kLargestCells, threads_, [this] {
    return [this](std::size_t task) { decide_blocks(ColorCell::at(task, kLargestSide)); };
  });
  number_undecided_blocks();
  const std::size_t tasks = (undecided_blocks_.size() + kBlocksPerTask - 1) / kBlocksPerTask;
  share_out(tasks, threads_, [this] {
    return [this, colors = BlockColors(kBlocksPerTask)](std::size_t task) mutable {
      label_blocks(task * kBlocksPerTask, colors);
    };
  });
  close_gaps();
}

std::optional<Label> TableCompiler::label_of(const ColorCell& cell) const {
  const ColorBox box = cell.box();
  const std::optional<Label> label = segmenter_.label_of(box, normalizer_.bounds(box));
  if (label && *label >= palette_size_) refuse_label(*label, cell.b, cell.g, cell.r, palette_size_);
  return label;
}

void TableCompiler::decide_blocks(const ColorCell& cell) {
  const std::optional<Label> label = label_of(cell);
  if (!label && cell.side > kBlockSide) {
    for (unsigned i = 0; i < kOctants; ++i) decide_blocks(cell.octant(i));
    return;
  }
  const std::uint16_t id = label ? *label : kUndecided;
  const std::size_t blocks = cell.side / kBlockSide;
  std::uint16_t* first = block_ids.data() + ColorTable::block_index(cell.b, cell.g, cell.r);
  for (std::size_t r = 0; r < blocks; ++r) {
    for (std::size_t g = 0; g < blocks; ++g) {
      std::fill_n(first + (r * kBlocksPerSide + g) * kBlocksPerSide, blocks, id);
    }
  }
}

void TableCompiler::number_undecided_blocks() {
  std::size_t next = uniform_blocks;
  for (std::size_t block = 0; block < block_ids.size(); ++block) {
    if (block_ids[block] != kUndecided) continue;
    block_ids[block] = static_cast<std::uint16_t>(next++);
    undecided_blocks_.push_back(static_cast<std::uint16_t>(block));
  }
  block_labels.resize(next * ColorTable::kColorsPerBlock);
  for (std::size_t label = 0; label < uniform_blocks; ++label) {
    std::fill_n(labels_of_block(label), ColorTable::kColorsPerBlock, static_cast<Label>(label));
  }
}

void TableCompiler::label_blocks(std::size_t first, BlockColors& colors) {
  const std::size_t count = std::min(kBlocksPerTask, undecided_blocks_.size() - first);
  const std::span<const std::uint16_t> blocks(undecided_blocks_.data() + first, count);
  Label* labels = labels_of_block(uniform_blocks + first);
  colors.label(normalizer_, segmenter_, palette_size_, blocks,
               {labels, count * ColorTable::kColorsPerBlock});
  for (const std::uint16_t block : blocks) {
    if (is_one_label(labels)) block_ids[block] = labels[0];
    labels += ColorTable::kColorsPerBlock;
  }
}

// Blocks that turned out to be of one label have left theirs behind.
void TableCompiler::close_gaps() {
  std::size_t next = uniform_blocks;
  for (const std::uint16_t block : undecided_blocks_) {
    std::uint16_t& id = block_ids[block];
    if (id < uniform_blocks) continue;
    if (id != next) {
      std::memcpy(labels_of_block(next), labels_of_block(id), ColorTable::kColorsPerBlock);
      id = static_cast<std::uint16_t>(next);
    }
    ++next;
  }
  block_labels.resize(next * ColorTable::kColorsPerBlock);
  // Bounds leave few gaps, which are cheaper to keep than to copy the rest; without bounds the gaps
  // are most of 16 MiB.
  if (block_labels.size() < block_labels.capacity() / 2) block_labels.shrink_to_fit();
}

Label* TableCompiler::labels_of_block(std::size_t id) {
  return block_labels.data() + id * ColorTable::kColorsPerBlock;
}

}  // namespace maggic
