#pragma once
/// The vector instruction set the frame path runs with. The widest the machine has is taken by
/// itself; choosing another is for tests and measurements, since results never depend on it.

#include <string>
#include <string_view>
#include <vector>

namespace maggic {

/// Those that this machine and this build have, widest first, in Highway's names: "AVX3" (AVX-512),
/// "AVX2", "SSE4", "SSSE3", "NEON", …, and last "SCALAR", plain code.
std::vector<std::string> simd_targets();

/// The one in use.
std::string simd_target();

/// Uses `name` from the next frame on, in the whole process; empty: the widest.
/// @throws std::invalid_argument when it is none of `simd_targets()`.
void use_simd_target(std::string_view name);

}  // namespace maggic
