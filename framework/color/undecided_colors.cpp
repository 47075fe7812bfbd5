#include "color/undecided_colors.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr std::size_t kSide = UndecidedColors::kSide;
constexpr std::size_t kColorsPerCell = kSide * kSide * kSide;

using Steps = std::array<std::uint8_t, kColorsPerCell>;

// How far each colour of a cell lies above the lowest, in one channel; blue changes fastest.
constexpr Steps steps_of(std::size_t stride) {
  Steps steps{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = static_cast<std::uint8_t>(i / stride % kSide);
  }
  return steps;
}
constexpr Steps kBlueSteps = steps_of(1);
constexpr Steps kGreenSteps = steps_of(kSide);
constexpr Steps kRedSteps = steps_of(kSide * kSide);

void write_channel(std::uint8_t lowest, const Steps& steps, std::uint8_t* __restrict out) {
  for (std::size_t i = 0; i < kColorsPerCell; ++i) {
    out[i] = static_cast<std::uint8_t>(lowest + steps[i]);
  }
}

constexpr std::size_t kGreenStride = ColorTable::within_block(0, 1, 0);
constexpr std::size_t kRedStride = ColorTable::within_block(0, 0, 1);

void write_cell(const Label* __restrict labels, Label* __restrict place) {
  for (std::size_t r = 0; r < kSide; ++r) {
    for (std::size_t g = 0; g < kSide; ++g) {
      std::memcpy(place + g * kGreenStride + r * kRedStride, labels, kSide);
      labels += kSide;
    }
  }
}

}  // namespace

UndecidedColors::UndecidedColors(std::size_t max_cells)
    : capacity_(max_cells * kColorsPerCell), planes_(7 * capacity_) {
  places_.reserve(max_cells);
}

std::span<std::uint8_t> UndecidedColors::plane(std::size_t index, std::size_t size) {
  return {planes_.data() + index * capacity_, size};
}

void UndecidedColors::add(std::uint8_t b, std::uint8_t g, std::uint8_t r, Label* labels) {
  std::uint8_t* blue = planes_.data() + places_.size() * kColorsPerCell;
  write_channel(b, kBlueSteps, blue);
  write_channel(g, kGreenSteps, blue + capacity_);
  write_channel(r, kRedSteps, blue + 2 * capacity_);
  places_.push_back(labels);
}

void UndecidedColors::label(const ColorNormalizer& normalizer, const ColorSegmenter& segmenter,
                            std::size_t palette_size) {
  const std::size_t size = places_.size() * kColorsPerCell;
  if (size == 0) return;
  const ColorBatch colors{plane(0, size), plane(1, size), plane(2, size)};
  const MutableColorBatch normalized{plane(3, size), plane(4, size), plane(5, size)};
  const std::span<Label> labels = plane(6, size);
  normalizer.normalize(colors, normalized);
  segmenter.segment(colors, normalized.as_const(), labels);
  Label highest = 0;
  for (const Label label : labels) highest = label > highest ? label : highest;
  if (highest >= palette_size) {
    const auto i = static_cast<std::size_t>(std::ranges::max_element(labels) - labels.begin());
    refuse_label(labels[i], colors.b[i], colors.g[i], colors.r[i], palette_size);
  }
  for (std::size_t cell = 0; cell < places_.size(); ++cell) {
    write_cell(labels.data() + cell * kColorsPerCell, places_[cell]);
  }
  places_.clear();
}

void fill_cell(Label label, Label* labels) {
  for (std::size_t r = 0; r < kSide; ++r) {
    for (std::size_t g = 0; g < kSide; ++g) {
      std::memset(labels + g * kGreenStride + r * kRedStride, label, kSide);
    }
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
