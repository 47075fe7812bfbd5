#pragma once
/// The colour of a lamp, from its colour temperature.

#include <array>

namespace maggic {

inline constexpr double kLowestKelvin = 2000.0;
inline constexpr double kHighestKelvin = 20000.0;
inline constexpr double kWhiteKelvin = 6500.0;

/// What a camera balanced for 6500 K makes of white paper under a black body of this temperature:
/// factors for red, green, blue. Green is always 1, and all are 1 at 6500 K.
///
/// The Planckian locus in CIE 1931 x, y by the cubics of Kim et al. (US patent 7024034, 2006), then
/// linear sRGB (IEC 61966-2-1), each channel over its value at 6500 K, divided by green's.
/// @param kelvin in [kLowestKelvin, kHighestKelvin].
std::array<double, 3> lamp_gains(double kelvin);

}  // namespace maggic
