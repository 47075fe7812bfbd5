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

#include <cstdint>

#include "../length_normalizer.hpp"
#include "maggic/plugin.hpp"

namespace {

constexpr std::uint32_t weighed(std::uint32_t c) { return c * c; }

class Weighted final : public maggic::LengthNormalizer<weighed> {};

}  // namespace

MAGGIC_PLUGIN(Weighted, "pure colours stay bright, grayish ones turn dark: c² / |v|")
