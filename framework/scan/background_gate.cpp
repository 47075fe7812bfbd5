#include "scan/background_gate.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace maggic {
namespace {

constexpr int kSide = ColorTable::kBlockSide;

struct Corner {
  std::uint8_t b, g, r;
};

Corner lowest_color(std::size_t block) {
  return {static_cast<std::uint8_t>((block & 31) * kSide),
          static_cast<std::uint8_t>((block >> 5 & 31) * kSide),
          static_cast<std::uint8_t>((block >> 10) * kSide)};
}

// The smallest spread within a block: its colours may be as gray as its shape allows.
int smallest_spread(const Corner& low) {
  const int nearest = std::max({low.b, low.g, low.r}) - std::min({low.b, low.g, low.r});
  return std::max(0, nearest - (kSide - 1));
}

// All blocks, by how gray their colours may be: once a gray one has shown a label, few of the
// others can show one of less spread.
const std::vector<std::uint16_t>& grayest_first() {
  static const std::vector<std::uint16_t> order = [] {
    std::vector<std::uint16_t> blocks(ColorTable::kBlocks);
    std::iota(blocks.begin(), blocks.end(), std::uint16_t{0});
    std::ranges::stable_sort(
        blocks, {}, [](std::uint16_t block) { return smallest_spread(lowest_color(block)); });
    return blocks;
  }();
  return order;
}

// The smallest spread of a colour of the block that has a label, at most `limit`.
int smallest_colored_spread(const Corner& low, const Label* labels, int limit) {
  for (int r = low.r; r < low.r + kSide; ++r) {
    for (int g = low.g; g < low.g + kSide; ++g) {
      for (int b = low.b; b < low.b + kSide; ++b, ++labels) {
        const int spread = std::max({b, g, r}) - std::min({b, g, r});
        if (*labels != kBackground && spread < limit) limit = spread;
      }
    }
  }
  return limit;
}

}  // namespace

BackgroundGate::BackgroundGate(const ColorTable& table) {
  first_.fill(255);
  for (const std::uint16_t block : grayest_first()) {
    const Label* labels = table.block(block);
    const Corner low = lowest_color(block);
    // All colours of a block share the sixteenth: its side divides 16, and the largest channel is
    // that of the largest corner.
    std::uint8_t& first = first_[std::max({low.b, low.g, low.r}) >> 4];
    if (smallest_spread(low) >= first) continue;
    if (table.is_uniform(block)) {
      if (labels[0] != kBackground) first = static_cast<std::uint8_t>(smallest_spread(low));
    } else {
      first = static_cast<std::uint8_t>(smallest_colored_spread(low, labels, first));
    }
  }
}

bool BackgroundGate::helps() const {
  return std::ranges::any_of(first_, [](std::uint8_t spread) { return spread > 0; });
}

}  // namespace maggic
