#pragma once
/// Colours that have to be asked for one by one, collected so that they can be asked for together.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maggic/color_table.hpp"

namespace maggic {

/// Collects cells of 4×4×4 colours, runs them through both stages in one batch and writes the
/// labels to where each cell belongs. Allocates when made, not afterwards.
class UndecidedColors {
 public:
  static constexpr std::size_t kSide = 4;  ///< Of a cell, in colours.

  /// @param max_cells how many cells are collected at most.
  explicit UndecidedColors(std::size_t max_cells);

  /// @param b, g, r the smallest channels of the cell's colours.
  /// @param labels where the label of (b, g, r) belongs, in a block of a ColorTable.
  void add(std::uint8_t b, std::uint8_t g, std::uint8_t r, Label* labels);

  /// Labels the colours collected, and forgets them.
  /// @throws std::logic_error when the segmenter answers a label of `palette_size` or above.
  void label(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
             std::size_t palette_size);

 private:
  std::span<std::uint8_t> plane(std::size_t index, std::size_t size);

  std::size_t capacity_;              ///< Of a plane, in colours.
  std::vector<std::uint8_t> planes_;  ///< Original B, G, R, normalised B, G, R, and the labels.
  std::vector<Label*> places_;        ///< By cell.
};

/// Gives a cell of 4×4×4 colours one label. @param labels as for UndecidedColors::add.
void fill_cell(Label label, Label* labels);

/// Says which label the palette does not have. @throws std::logic_error, always.
[[noreturn]] void refuse_label(Label label, std::uint8_t b, std::uint8_t g, std::uint8_t r,
                               std::size_t palette_size);

}  // namespace maggic
