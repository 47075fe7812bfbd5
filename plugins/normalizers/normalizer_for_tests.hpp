#pragma once
/// What the tests of the colour normalizers share: one colour, and all 2^24 of them.

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "maggic/testing.hpp"

namespace maggic {

using Rgb = std::array<std::uint8_t, 3>;

// Sanitizer builds run 20 times slower and look for memory errors: every 15th red does there, both
// ends included.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr unsigned kRedStep = 15;
#else
inline constexpr unsigned kRedStep = 1;
#endif

/// A loaded normalizer without parameters.
class NormalizerForTests {
 public:
  explicit NormalizerForTests(std::string_view name) : stage_(testing::make<Normalizer>(name)) {}

  Rgb operator()(Rgb rgb) const {
    Rgb out;
    normalizer().normalize({{&rgb[2], 1}, {&rgb[1], 1}, {&rgb[0], 1}},
                           {{&out[2], 1}, {&out[1], 1}, {&out[0], 1}});
    return out;
  }

  /// @param is_exact whether `q` is the right answer for channel `c` of the colour `rgb`.
  /// @return for how many of the 2^24 colours (of every kRedStep-th red) a channel is wrong.
  template <class F>
  std::size_t count_wrong(F is_exact) const {
    constexpr std::size_t kBatch = 256 * 256;
    std::vector<std::uint8_t> b(kBatch), g(kBatch), r(kBatch);
    std::vector<std::uint8_t> out_b(kBatch), out_g(kBatch), out_r(kBatch);
    for (std::size_t i = 0; i < kBatch; ++i) {
      b[i] = static_cast<std::uint8_t>(i & 255);
      g[i] = static_cast<std::uint8_t>(i >> 8);
    }
    std::size_t wrong = 0;
    for (unsigned red = 0; red < 256; red += kRedStep) {
      r.assign(kBatch, static_cast<std::uint8_t>(red));
      normalizer().normalize({b, g, r}, {out_b, out_g, out_r});
      for (std::size_t i = 0; i < kBatch; ++i) {
        const Rgb rgb{r[i], g[i], b[i]};
        wrong += !is_exact(out_b[i], b[i], rgb) || !is_exact(out_g[i], g[i], rgb) ||
                 !is_exact(out_r[i], r[i], rgb);
      }
    }
    return wrong;
  }

 private:
  const ColorNormalizer& normalizer() const {
    return dynamic_cast<const ColorNormalizer&>(*stage_);
  }

  StagePtr<Normalizer> stage_;
};

/// Whether q = floor(sqrt(numerator² / |v|²)), in integers: the largest q with
/// q² |v|² <= numerator²; 0 for black.
inline bool is_floor_over_length(std::uint64_t q, std::uint64_t numerator, const Rgb& rgb) {
  std::uint64_t squared = 0;
  for (const std::uint64_t channel : rgb) squared += channel * channel;
  if (squared == 0) return q == 0;
  return q * q * squared <= numerator * numerator &&
         (q + 1) * (q + 1) * squared > numerator * numerator;
}

}  // namespace maggic
