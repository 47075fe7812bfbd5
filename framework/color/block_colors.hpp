#pragma once
/// Blocks of the colour cube whose colours are run through both stages one by one.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maggic/normalizer.hpp"
#include "maggic/palette.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// Lists the colours of several blocks of a ColorTable and labels them in one batch. Allocates when
/// made, not afterwards.
class BlockColors {
 public:
  /// @param max_blocks how many blocks are labelled at once at most.
  explicit BlockColors(std::size_t max_blocks);

  /// Labels all colours of some blocks.
  /// @param blocks ColorTable::block_index of each, at most `max_blocks`.
  /// @param labels ColorTable::kColorsPerBlock for each, in the order of `blocks`.
  /// @throws std::logic_error when the segmenter answers a label of `palette_size` or above.
  void label(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
             std::size_t palette_size, std::span<const std::uint16_t> blocks,
             std::span<Label> labels);

 private:
  std::span<std::uint8_t> plane(std::size_t index, std::size_t size);

  std::size_t capacity_;              ///< Of a plane, in colours.
  std::vector<std::uint8_t> planes_;  ///< Original B, G, R, then normalised B, G, R.
};

/// Says which label the palette does not have. @throws std::logic_error, always.
[[noreturn]] void refuse_label(Label label, std::uint8_t b, std::uint8_t g, std::uint8_t r,
                               std::size_t palette_size);

}  // namespace maggic
