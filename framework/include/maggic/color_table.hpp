#pragma once
/// The look-up table from every possible colour to its label.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "maggic/normalizer.hpp"
#include "maggic/palette.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// A normalizer and a segmenter compiled into one answer per colour, before the match, so that the
/// method costs nothing per frame (MaggicVision, "look-up table"). Exact: for all 2^24 colours it
/// equals the stage chain.
class ColorTable {
 public:
  static constexpr std::size_t kColors = std::size_t{1} << 24;

  /// Every colour is background.
  ColorTable();

  /// Runs all 2^24 colours through `normalizer` then `segmenter`, split over `threads` (at least
  /// 1; 0 means one per core).
  /// @throws std::logic_error when the segmenter answers a label of `palette_size` or above.
  static ColorTable compile(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                            std::size_t palette_size, unsigned threads = 0);

  Label operator()(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return labels_[index(b, g, r)];
  }

  /// All labels, at `index(b, g, r)`: 16 MiB.
  const std::vector<Label>& labels() const { return labels_; }

  static constexpr std::size_t index(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return std::size_t{r} << 16 | std::size_t{g} << 8 | b;
  }

 private:
  std::vector<Label> labels_;
};

}  // namespace maggic
