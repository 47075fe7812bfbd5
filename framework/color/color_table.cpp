#include "maggic/color_table.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include "color/table_compiler.hpp"

namespace maggic {

ColorTable::ColorTable() : block_ids_(kBlocks, 0), block_labels_(kColorsPerBlock, kBackground) {}

ColorTable ColorTable::compile(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                               std::size_t palette_size, unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  TableCompiler compiler(normalizer, segmenter, palette_size, threads);
  compiler.run();
  ColorTable table;
  table.block_ids_ = std::move(compiler.block_ids);
  table.block_labels_ = std::move(compiler.block_labels);
  table.uniform_blocks_ = compiler.uniform_blocks;
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
