#pragma once
/// The inner loops of the scan: one pass from pixels, or labels, to runs. Compiled once for every
/// vector instruction set and chosen when the program runs.

#include <cstddef>
#include <cstdint>
#include <span>

#include "maggic/blob.hpp"
#include "maggic/scan_area.hpp"
#include "scan/run_buffer.hpp"

namespace maggic {

/// What the kernels need of the table, the gate and the gains; see ColorTable, BackgroundGate and
/// ChannelGains. All borrowed.
struct ColorLookUp {
  const std::uint16_t* block_ids = nullptr;
  const Label* block_labels = nullptr;
  const std::uint8_t* first_colored_spread = nullptr;  ///< 16 entries; null: no gate.
  const std::uint16_t* gains_q12 = nullptr;            ///< Blue, green, red; null: as they are.
};

/// A picture to read by rows. Borrowed.
struct PictureRows {
  const std::uint8_t* data = nullptr;
  std::size_t step = 0;  ///< Bytes from row to row.
};

/// Appends to `runs` the maximal runs of equal non-background label within each span of `area`; a
/// run that would go on in the next span is cut there.
/// @param bgr three bytes a pixel; nothing outside `area` is read.
void scan_colors(const PictureRows& bgr, std::span<const RowSpan> area, const ColorLookUp& look_up,
                 RunBuffer& runs);

/// The same of a picture of labels. @param labels one byte a pixel.
void scan_labels(const PictureRows& labels, std::span<const RowSpan> area, RunBuffer& runs);

}  // namespace maggic
