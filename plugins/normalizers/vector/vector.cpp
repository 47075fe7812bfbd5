/// vector: every colour at one length (VNT)
/// ========================================
///
/// What it does: takes the colour as a vector and stretches it to length 255, 255·c / |v| with
/// |v| = sqrt(R²+G²+B²), truncated; black stays black. (200, 200, 30) becomes (179, 179, 26).
/// When to use it: as `chromatic`, with brighter results that keep more steps between colours.
///
///     normalizer: vector
///
/// No parameters. Source: MaggicVision, vector normalisation transform.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "maggic/length_scale.hpp"
#include "maggic/plugin.hpp"

namespace {

class Vector final : public maggic::ColorNormalizer {
 public:
  void prepare(const maggic::StageContext& /*context*/) override { scale_.emplace(numerators()); }

  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    constexpr std::size_t kPiece = 1024;
    std::array<float, kPiece> factors;
    for (std::size_t start = 0; start < in.size(); start += kPiece) {
      const std::size_t count = std::min(kPiece, in.size() - start);
      const std::span<float> piece_factors(factors.data(), count);
      scale_->look_up({in.b.subspan(start, count), in.g.subspan(start, count),
                      in.r.subspan(start, count)},
                     piece_factors);
      stretch(in.b.data() + start, piece_factors, out.b.data() + start);
      stretch(in.g.data() + start, piece_factors, out.g.data() + start);
      stretch(in.r.data() + start, piece_factors, out.r.data() + start);
    }
  }

 private:
  static void stretch(const std::uint8_t* __restrict in, std::span<const float> factors,
                      std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      out[i] = static_cast<std::uint8_t>(
          static_cast<int>(static_cast<float>(255 * in[i]) * factors[i]));
    }
  }

  static std::array<std::uint32_t, 256> numerators() {
    std::array<std::uint32_t, 256> values;
    for (std::uint32_t c = 0; c < values.size(); ++c) values[c] = 255 * c;
    return values;
  }

  std::optional<maggic::LengthScale> scale_;
};

}  // namespace

MAGGIC_PLUGIN(Vector, "every colour at one length: 255·c / |v|")
