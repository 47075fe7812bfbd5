#include "color/block_colors.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "color/color_cell.hpp"
#include "maggic/color_table.hpp"
#include "maggic/vectorized.hpp"

namespace maggic {
namespace {

constexpr std::size_t kColorsPerBlock = ColorTable::kColorsPerBlock;
constexpr std::uint8_t kSide = ColorTable::kBlockSide;

using Steps = std::array<std::uint8_t, kColorsPerBlock>;

// How far each colour of a block lies above the lowest, in one channel.
constexpr Steps steps_of(std::size_t stride) {
  Steps steps{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = static_cast<std::uint8_t>(i / stride % kSide);
  }
  return steps;
}
constexpr Steps kBlueSteps = steps_of(ColorTable::within_block(1, 0, 0));
constexpr Steps kGreenSteps = steps_of(ColorTable::within_block(0, 1, 0));
constexpr Steps kRedSteps = steps_of(ColorTable::within_block(0, 0, 1));

MAGGIC_VECTORIZED void write_channel(std::uint8_t lowest, const Steps& steps,
                                     std::uint8_t* __restrict out) {
  for (std::size_t i = 0; i < kColorsPerBlock; ++i) {
    out[i] = static_cast<std::uint8_t>(lowest + steps[i]);
  }
}

MAGGIC_VECTORIZED Label highest_label(std::span<const Label> labels) {
  Label highest = 0;
  for (const Label label : labels) highest = label > highest ? label : highest;
  return highest;
}

}  // namespace

BlockColors::BlockColors(std::size_t max_blocks)
    : capacity_(max_blocks * kColorsPerBlock), planes_(6 * capacity_) {}

std::span<std::uint8_t> BlockColors::plane(std::size_t index, std::size_t size) {
  return {planes_.data() + index * capacity_, size};
}

void BlockColors::label(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                        std::size_t palette_size, std::span<const std::uint16_t> blocks,
                        std::span<Label> labels) {
  std::uint8_t* place = planes_.data();
  for (const std::uint16_t block : blocks) {
    const ColorCell cell = ColorCell::at(block, kSide);
    write_channel(cell.b, kBlueSteps, place);
    write_channel(cell.g, kGreenSteps, place + capacity_);
    write_channel(cell.r, kRedSteps, place + 2 * capacity_);
    place += kColorsPerBlock;
  }
  const std::size_t size = labels.size();
  const ColorBatch colors{plane(0, size), plane(1, size), plane(2, size)};
  const MutableColorBatch normalized{plane(3, size), plane(4, size), plane(5, size)};
  normalizer.normalize(colors, normalized);
  segmenter.segment(colors, normalized.as_const(), labels);
  if (highest_label(labels) >= palette_size) {
    const auto i = static_cast<std::size_t>(std::ranges::max_element(labels) - labels.begin());
    refuse_label(labels[i], colors.b[i], colors.g[i], colors.r[i], palette_size);
  }
}

void refuse_label(Label label, std::uint8_t b, std::uint8_t g, std::uint8_t r,
                  std::size_t palette_size) {
  throw std::logic_error(fmt::format(
      "the segmenter gave colour B {} G {} R {} the label {}; expected a label below the palette's "
      "size {}",
      b, g, r, label, palette_size));
}

}  // namespace maggic
