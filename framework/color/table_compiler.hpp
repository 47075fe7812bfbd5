#pragma once
/// How a ColorTable comes about without asking for each of 2^24 colours; docs/adr/0006.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "color/block_colors.hpp"
#include "color/color_cell.hpp"
#include "maggic/label_vector.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// Walks the colour cube from large cells to small ones. Cells that the stages' bounds decide are
/// filled, the colours of blocks that stay undecided are run through both stages. Used once.
class TableCompiler {
 public:
  /// @param threads at least 1.
  TableCompiler(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                std::size_t palette_size, unsigned threads);

  /// @throws std::logic_error when the segmenter answers a label of `palette_size` or above; what
  ///         the stages throw.
  void run();

  /// The table's two levels, see ColorTable; to be taken after `run`.
  std::vector<std::uint16_t> block_ids;
  LabelVector block_labels;
  /// How many blocks of `block_labels` are of one label each: the first ones, label i's being
  /// number i.
  std::size_t uniform_blocks;

 private:
  std::optional<Label> label_of(const ColorCell& cell) const;
  void decide_blocks(const ColorCell& cell);
  void number_undecided_blocks();
  void label_blocks(std::size_t first, BlockColors& colors);
  void close_gaps();

  Label* labels_of_block(std::size_t id);

  const ColorNormalizer& normalizer_;
  const ColorSegmenter& segmenter_;
  std::size_t palette_size_;
  unsigned threads_;
  std::vector<std::uint16_t> undecided_blocks_;  ///< Ascending.
};

}  // namespace maggic
