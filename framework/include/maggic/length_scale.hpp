#pragma once
/// Exact division by a colour's length, as a multiplication.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maggic/color_batch.hpp"

namespace maggic {

/// For normalizers that divide by |v| = sqrt(R²+G²+B²): holds one factor for every squared length
/// such that, for every channel value c that a colour of that length can have,
///
///     static_cast<int>(static_cast<float>(numerators[c]) * factor) == floor(numerators[c] / |v|)
///
/// exactly, although a plain float division would be off where the quotient lies next to an
/// integer. One load and one multiplication instead of a root and a division in double.
class LengthScale {
 public:
  static constexpr std::uint32_t kMaxSquaredLength = 3 * 255 * 255;

  /// @param numerators what channel value c stands for, growing with c; numerators[c] at most
  ///        255·c, so that the quotient stays in 8 bits, and numerators[0] is 0.
  explicit LengthScale(const std::array<std::uint32_t, 256>& numerators);

  /// Writes the factor of every colour of `colors`; black's is 0.
  /// @param factors of the batch's size.
  void look_up(const ColorBatch& colors, std::span<float> factors) const;

  /// The factor of the colour with these channels, in any order.
  float factor(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return factors_[static_cast<std::size_t>(b * b + g * g + r * r)];
  }

 private:
  std::vector<float> factors_;
};

}  // namespace maggic
