#include "maggic/length_scale.hpp"

#include <algorithm>
#include <limits>

#include "maggic/vectorized.hpp"

namespace maggic {
namespace {

// Apart from the look-up, so that it vectorises.
MAGGIC_VECTORIZED void square_lengths(const ColorBatch& colors, std::uint32_t* __restrict squared) {
  const std::uint8_t* __restrict b = colors.b.data();
  const std::uint8_t* __restrict g = colors.g.data();
  const std::uint8_t* __restrict r = colors.r.data();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto bb = static_cast<std::uint16_t>(b[i] * b[i]);
    const auto gg = static_cast<std::uint16_t>(g[i] * g[i]);
    const auto rr = static_cast<std::uint16_t>(r[i] * r[i]);
    squared[i] = std::uint32_t{bb} + gg + rr;
  }
}

}  // namespace

// A factor k is right for squared length n when, for every c, q = floor(numerators[c] / sqrt(n)) is
// the integer part of numerators[c]·k: q / numerators[c] <= k < (q+1) / numerators[c]. Each
// fraction q / numerators[c] is a lower bound while q² n <= numerators[c]², and an upper bound for
// all longer colours, so two running extremes over n give the interval that is left. Its middle is
// far enough from both ends for the rounding of a float; a test checks every n and c.
LengthScale::LengthScale(const std::array<std::uint32_t, 256>& numerators)
    : factors_(kMaxSquaredLength + 1, 0.0F) {
  std::vector<double> lower(factors_.size(), 0.0);
  std::vector<double> upper(factors_.size(), std::numeric_limits<double>::infinity());
  for (std::uint64_t c = 1; c <= 255; ++c) {
    const std::uint64_t numerator = numerators[c];
    for (std::uint64_t q = 1; q <= 256; ++q) {
      const double bound = static_cast<double>(q) / static_cast<double>(numerator);
      const std::uint64_t last_below = numerator * numerator / (q * q);
      // No colour with a channel of c is shorter than c.
      const std::uint64_t first_above = std::max(last_below + 1, c * c);
      if (first_above < upper.size()) upper[first_above] = std::min(upper[first_above], bound);
      if (last_below < c * c) break;
      const std::uint64_t last = std::min<std::uint64_t>(last_below, kMaxSquaredLength);
      lower[last] = std::max(lower[last], bound);
    }
  }
  for (std::size_t n = 1; n < upper.size(); ++n) upper[n] = std::min(upper[n], upper[n - 1]);
  for (std::size_t n = lower.size() - 1; n > 0; --n) {
    lower[n - 1] = std::max(lower[n - 1], lower[n]);
  }
  for (std::size_t n = 1; n < factors_.size(); ++n) {
    factors_[n] = static_cast<float>((lower[n] + upper[n]) / 2);
  }
}

void LengthScale::look_up(const ColorBatch& colors, std::span<float> factors) const {
  constexpr std::size_t kPiece = 1024;
  std::array<std::uint32_t, kPiece> squared;
  for (std::size_t start = 0; start < colors.size(); start += kPiece) {
    const std::size_t count = std::min(kPiece, colors.size() - start);
    square_lengths({colors.b.subspan(start, count), colors.g.subspan(start, count),
                    colors.r.subspan(start, count)},
                   squared.data());
    const float* table = factors_.data();
    float* __restrict out = factors.data() + start;
    // The instructions of a loop not unrolled take longer than the look-ups.
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = table[squared[i]];
  }
}

}  // namespace maggic
