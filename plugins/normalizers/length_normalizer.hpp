#pragma once
/// What the normalizers share that divide by a colour's length |v| = sqrt(R²+G²+B²).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "maggic/length_scale.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/vectorized.hpp"

namespace maggic {

/// Every channel c becomes numerator(c) / |v|, truncated; black stays black.
/// @tparam numerator as LengthScale asks for it, and such that numerator(c) / |v| grows with c.
template <std::uint32_t (*numerator)(std::uint32_t c)>
class LengthNormalizer : public ColorNormalizer {
 public:
  void prepare(const StageContext& /*context*/) override {
    std::array<std::uint32_t, 256> numerators;
    for (std::uint32_t c = 0; c < numerators.size(); ++c) numerators[c] = numerator(c);
    scale_.emplace(numerators);
  }

  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    constexpr std::size_t kPiece = 1024;
    std::array<float, kPiece> factors;
    for (std::size_t start = 0; start < in.size(); start += kPiece) {
      const std::size_t count = std::min(kPiece, in.size() - start);
      const std::span<float> piece_factors(factors.data(), count);
      scale_->look_up(
          {in.b.subspan(start, count), in.g.subspan(start, count), in.r.subspan(start, count)},
          piece_factors);
      multiply(in.b.data() + start, piece_factors, out.b.data() + start);
      multiply(in.g.data() + start, piece_factors, out.g.data() + start);
      multiply(in.r.data() + start, piece_factors, out.r.data() + start);
    }
  }

  // A channel's result grows with the channel and falls with the other two.
  ColorBox bounds(const ColorBox& in) const override {
    return {range(in.b, in.g, in.r), range(in.g, in.r, in.b), range(in.r, in.b, in.g)};
  }

 private:
  MAGGIC_VECTORIZED static void multiply(const std::uint8_t* __restrict in,
                                         std::span<const float> factors,
                                         std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      out[i] = truncated(in[i], factors[i]);
    }
  }

  static std::uint8_t truncated(std::uint8_t c, float factor) {
    const auto product = static_cast<float>(static_cast<int>(numerator(c))) * factor;
    return static_cast<std::uint8_t>(static_cast<int>(product));
  }

  ChannelRange range(ChannelRange own, ChannelRange other, ChannelRange third) const {
    const float smallest = scale_->factor(own.first, other.last, third.last);
    const float largest = scale_->factor(own.last, other.first, third.first);
    return {truncated(own.first, smallest), truncated(own.last, largest)};
  }

  std::optional<LengthScale> scale_;
};

}  // namespace maggic
