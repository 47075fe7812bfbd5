#pragma once
/// The look-up table from every possible colour to its label.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maggic/label_vector.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/palette.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// A normalizer and a segmenter compiled into one answer per colour, before the match, so that the
/// method costs nothing per frame (MaggicVision, "look-up table"). Exact: for all 2^24 colours it
/// equals the stage chain.
///
/// In two levels, so that it fits a core's cache: the colour cube is cut into 32×32×32 blocks of
/// 8×8×8 colours, and all blocks of one label share one block of labels.
class ColorTable {
 public:
  static constexpr std::size_t kColors = std::size_t{1} << 24;
  static constexpr std::size_t kBlocks = 32768;
  static constexpr std::size_t kBlockSide = 8;  ///< In colours, along each channel.
  static constexpr std::size_t kColorsPerBlock = kBlockSide * kBlockSide * kBlockSide;

  /// Every colour is background.
  ColorTable();

  /// What `normalizer` then `segmenter` answer for each of 2^24 colours. Boxes of colours whose
  /// label their `bounds` and `label_of` settle are not asked for one by one. Work is split over
  /// `threads` (at least 1; 0 means one per core). The table depends neither on their number nor on
  /// what the stages say of boxes.
  /// @throws std::logic_error when the segmenter answers a label of `palette_size` or above.
  static ColorTable compile(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                            std::size_t palette_size, unsigned threads = 0);

  Label operator()(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return block(block_index(b, g, r))[within_block(b, g, r)];
  }

  /// Which block of the cube holds a colour: blue changes fastest, then green.
  static constexpr std::size_t block_index(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return std::size_t{b} >> 3 | std::size_t{g} >> 3 << 5 | std::size_t{r} >> 3 << 10;
  }
  /// A colour's place within its block, in the same order.
  static constexpr std::size_t within_block(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return (b & 7U) | (g & 7U) << 3 | (r & 7U) << 6;
  }

  /// The `kColorsPerBlock` labels of a block of the cube, at `within_block(b, g, r)`.
  /// @param index below kBlocks.
  const Label* block(std::size_t index) const {
    return block_labels_.data() + kColorsPerBlock * block_ids_[index];
  }
  /// Whether all colours of a block are known to have one label.
  bool is_uniform(std::size_t index) const { return block_ids_[index] < uniform_blocks_; }

  /// The first level: for each of the kBlocks blocks, which of `block_labels` it shows, counted in
  /// blocks.
  std::span<const std::uint16_t> block_ids() const { return block_ids_; }
  /// The second level: blocks of labels, first those of one label only.
  std::span<const Label> block_labels() const { return block_labels_; }

  /// Whether both give every colour the same label.
  friend bool operator==(const ColorTable& a, const ColorTable& b);

 private:
  std::vector<std::uint16_t> block_ids_;
  LabelVector block_labels_;
  std::size_t uniform_blocks_ = 1;
};

}  // namespace maggic
