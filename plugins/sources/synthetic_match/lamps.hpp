#pragma once
/// The light of a hall: which lamps hang there and what falls onto every pixel.

#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace maggic::synthetic_match {

/// The classes of light of the MaggicVision monograph, and what this source gave before it knew
/// them.
enum class LightClass {
  kEven,         ///< White; one gradient across the picture.
  kIdeal,        ///< White, the same everywhere.
  kNormal,       ///< Four ceiling lamps, slightly bluish or yellowish, mild unevenness.
  kChallenging,  ///< Few strongly coloured lamps, a window's patch, dim; brown and purple clutter.
};

/// Factors on blue, green, red of every pixel, CV_32FC3; empty where light is white and the same
/// everywhere. Deterministic by seed: another seed hangs other lamps of the same class.
///
/// A lamp is a Lambertian disc hanging over the picture: its light falls off with cos⁴ of the angle
/// from its axis. The mean of the factors' green is 1 in kNormal and 0.5 … 0.7 in kChallenging,
/// where no pixel gets less than kDimmest of green.
cv::Mat light_over_picture(LightClass light, cv::Size picture, std::uint64_t seed);

inline constexpr double kDimmest = 0.35;

}  // namespace maggic::synthetic_match
