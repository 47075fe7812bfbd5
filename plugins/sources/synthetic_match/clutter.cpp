#include "clutter.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "random.hpp"

namespace maggic::synthetic_match {
namespace {

constexpr std::uint64_t kStream = 0x636c7574746572u;
constexpr Rgb kBrown{136, 88, 48};
constexpr Rgb kPurple{126, 62, 188};
constexpr double kBeyondWallMm = 30.0;

/// Lighter or darker than the dye, as no two scraps are alike.
Rgb shade_of(const Rgb& dye, Random& random) {
  const double shade = random.uniform(0.7, 1.15);
  return {shade * dye[0], shade * dye[1], shade * dye[2]};
}

Rgb brown_or_purple(Random& random) {
  return shade_of(random.uniform() < 0.5 ? kBrown : kPurple, random);
}

FloorPatch strip(cv::Point2d low, cv::Point2d high, const Rgb& color) {
  return {{low, {high.x, low.y}, high, {low.x, high.y}}, color};
}

FloorPatch scrap(cv::Point2d center, cv::Size2d size, double angle_rad, Random& random) {
  FloorPatch patch;
  const cv::Point2d along(std::cos(angle_rad), std::sin(angle_rad));
  const cv::Point2d across(-along.y, along.x);
  const std::array<cv::Point2d, 4> corners{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  for (const cv::Point2d& corner : corners) {
    // Torn, not cut: each corner lies a little off.
    patch.corners_mm.push_back(center +
                               size.width * (corner.x + random.uniform(-0.08, 0.08)) * along +
                               size.height * (corner.y + random.uniform(-0.08, 0.08)) * across);
  }
  patch.color = brown_or_purple(random);
  return patch;
}

/// A wavy band: there along one side, back along the other.
FloorPatch cable(cv::Point2d from, cv::Point2d to, Random& random) {
  constexpr int kSteps = 24;
  const cv::Point2d way = to - from;
  const double length = std::hypot(way.x, way.y);
  const cv::Point2d across = cv::Point2d(-way.y, way.x) / length;
  const double width_mm = random.uniform(7.0, 14.0);
  const double swing_mm = random.uniform(20.0, 70.0);
  const double waves = random.uniform(0.6, 1.8) * 2.0 * std::numbers::pi;
  const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  FloorPatch patch;
  for (const double side : {-0.5, 0.5}) {
    for (int i = 0; i <= kSteps; ++i) {
      const double u = static_cast<double>(side < 0.0 ? i : kSteps - i) / kSteps;
      const double offset = swing_mm * std::sin(waves * u + phase) + side * width_mm;
      patch.corners_mm.push_back(from + u * way + offset * across);
    }
  }
  patch.color = brown_or_purple(random);
  return patch;
}

}  // namespace

std::vector<FloorPatch> brown_and_purple_clutter(cv::Size2d field_mm, std::uint64_t seed) {
  Random random(seed ^ kStream);
  std::vector<FloorPatch> patches;
  const cv::Point2d half(field_mm.width / 2.0, field_mm.height / 2.0);
  const auto anywhere = [&](double part) {
    return cv::Point2d(random.uniform(-part, part) * half.x, random.uniform(-part, part) * half.y);
  };

  for (const double side : {-1.0, 1.0}) {  // boards behind the long walls and beside a goal
    const double near = side * (half.y + kBeyondWallMm);
    const double far = side * (half.y + kBeyondWallMm + random.uniform(20.0, 60.0));
    const double end = random.uniform(0.2, 1.0) * half.x;
    patches.push_back(strip({-half.x, std::min(near, far)}, {end, std::max(near, far)},
                            shade_of(kBrown, random)));
    const double from = side * (half.x + kBeyondWallMm);
    const double to = side * (half.x + kBeyondWallMm + random.uniform(30.0, 80.0));
    const double height = random.uniform(0.45, 0.95) * half.y;
    patches.push_back(strip({std::min(from, to), 0.36 * half.y}, {std::max(from, to), height},
                            shade_of(side < 0.0 ? kBrown : kPurple, random)));
  }
  for (int i = 0; i < 3; ++i) {  // one along the field's edge, two across a corner of it
    const cv::Point2d corner(i == 1 ? -half.x : half.x, i == 2 ? -half.y : half.y);
    patches.push_back(i == 0
                          ? cable({-1.1 * half.x, -half.y - 20.0}, {half.x, -half.y - 20.0}, random)
                          : cable({corner.x * 1.15, corner.y * random.uniform(0.3, 0.8)},
                                  {corner.x * random.uniform(0.3, 0.8), corner.y * 1.1}, random));
  }
  const std::array<cv::Size2d, 10> sizes{{{12, 14},
                                          {18, 16},
                                          {25, 20},
                                          {32, 66},
                                          {35, 70},
                                          {30, 30},
                                          {66, 32},
                                          {90, 55},
                                          {130, 90},
                                          {150, 40}}};
  for (const cv::Size2d& size : sizes) {
    patches.push_back(
        scrap(anywhere(0.92), size, random.uniform(0.0, 2.0 * std::numbers::pi), random));
  }
  return patches;
}

}  // namespace maggic::synthetic_match
