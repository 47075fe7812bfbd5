/// chromatic: every colour at one brightness sum (CNT)
/// ===================================================
///
/// What it does: divides each channel by the sum of the three, 255·c / (R+G+B), truncated; black
/// stays black. (200, 200, 30) becomes (118, 118, 17).
/// When to use it: light that changes in strength but not in colour. It also lifts the noise of
/// dark pixels to full colour, which `weighted` avoids.
///
///     normalizer: chromatic
///
/// No parameters. Source: MaggicVision, chromatic normalisation transform.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "maggic/plugin.hpp"
#include "maggic/vectorized.hpp"

namespace {

class Chromatic final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    // In pieces, a loop a channel: the compiler turns each into vector instructions.
    std::array<float, kPiece> inverse_sums;
    for (std::size_t start = 0; start < in.size(); start += kPiece) {
      const std::size_t count = std::min(kPiece, in.size() - start);
      const std::span<float> piece(inverse_sums.data(), count);
      invert_sums(in.b.data() + start, in.g.data() + start, in.r.data() + start, piece);
      share(in.b.data() + start, piece, out.b.data() + start);
      share(in.g.data() + start, piece, out.g.data() + start);
      share(in.r.data() + start, piece, out.r.data() + start);
    }
  }

  // A channel's share grows with the channel and falls with the other two.
  maggic::ColorBox bounds(const maggic::ColorBox& in) const override {
    return {range(in.b, in.g, in.r), range(in.g, in.r, in.b), range(in.r, in.b, in.g)};
  }

 private:
  static constexpr std::size_t kPiece = 1024;

  static std::uint8_t share_of(int own, int others) {
    return static_cast<std::uint8_t>(own == 0 ? 0 : 255 * own / (own + others));
  }

  static maggic::ChannelRange range(maggic::ChannelRange own, maggic::ChannelRange other,
                                    maggic::ChannelRange third) {
    return {share_of(own.first, other.last + third.last),
            share_of(own.last, other.first + third.first)};
  }

  MAGGIC_VECTORIZED static void invert_sums(const std::uint8_t* __restrict b,
                                            const std::uint8_t* __restrict g,
                                            const std::uint8_t* __restrict r,
                                            std::span<float> inverse_sums) {
    // The division gets a loop of its own: beside the test for black it would not vectorise.
    std::array<std::int16_t, kPiece> divisors;
    for (std::size_t i = 0; i < inverse_sums.size(); ++i) {
      const auto sum = static_cast<std::int16_t>(b[i] + g[i] + r[i]);
      divisors[i] = std::max<std::int16_t>(sum, 1);
    }
    for (std::size_t i = 0; i < inverse_sums.size(); ++i) {
      inverse_sums[i] = 1.0F / static_cast<float>(divisors[i]);
    }
  }

  // 255·c/sum is a multiple of 1/sum, so half a step more changes no integer part, and half a step
  // of at least 0.5/765 is far above a float's rounding: truncation is exact.
  MAGGIC_VECTORIZED static void share(const std::uint8_t* __restrict in,
                                      std::span<const float> inverse_sums,
                                      std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < inverse_sums.size(); ++i) {
      const float share = (255.0F * static_cast<float>(in[i]) + 0.5F) * inverse_sums[i];
      out[i] = static_cast<std::uint8_t>(static_cast<int>(share));
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(Chromatic, "every colour at one brightness sum: 255·c / (R+G+B)")
