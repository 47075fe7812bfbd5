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

#include <cstdint>

#include "../length_normalizer.hpp"
#include "maggic/plugin.hpp"

namespace {

constexpr std::uint32_t stretched(std::uint32_t c) { return 255 * c; }

class Vector final : public maggic::LengthNormalizer<stretched> {};

}  // namespace

MAGGIC_PLUGIN(Vector, "every colour at one length: 255·c / |v|")
