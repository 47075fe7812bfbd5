/// weighted: pure colours stay bright, grayish ones turn dark and gray (WNT)
/// =========================================================================
///
/// What it does: weighs each channel by its share of the colour's length, c² / |v| with
/// |v| = sqrt(R²+G²+B²), truncated; black stays black. (200, 200, 30) becomes (140, 140, 3) and
/// the nearly gray (100, 99, 99) becomes (58, 56, 56).
/// When to use it: the default for Maggic pipelines. Unlike `chromatic` and `vector` it does not
/// lift the noise of dark pixels, so one gray threshold parts field from tags.
///
///     normalizer: weighted
///
/// No parameters. Source: MaggicVision, weighted normalisation transform.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "maggic/length_scale.hpp"
#include "maggic/plugin.hpp"

namespace {

class Weighted final : public maggic::ColorNormalizer {
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
      weigh(in.b.data() + start, piece_factors, out.b.data() + start);
      weigh(in.g.data() + start, piece_factors, out.g.data() + start);
      weigh(in.r.data() + start, piece_factors, out.r.data() + start);
    }
  }

 private:
  static void weigh(const std::uint8_t* __restrict in, std::span<const float> factors,
                    std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      out[i] = static_cast<std::uint8_t>(
          static_cast<int>(static_cast<float>(in[i] * in[i]) * factors[i]));
    }
  }

  static std::array<std::uint32_t, 256> numerators() {
    std::array<std::uint32_t, 256> values;
    for (std::uint32_t c = 0; c < values.size(); ++c) values[c] = c * c;
    return values;
  }

  std::optional<maggic::LengthScale> scale_;
};

}  // namespace

MAGGIC_PLUGIN(Weighted, "pure colours stay bright, grayish ones turn dark: c² / |v|")
