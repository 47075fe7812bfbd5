#include "field/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr std::string_view kExpected =
    "expected the field's top-left, top-right, bottom-right, bottom-left corner as seen in the "
    "picture";

/// Sine of the turn at corner `i`, positive when clockwise on the screen.
double turn_at(std::span<const cv::Point2d> corners, std::size_t i) {
  const cv::Point2d in = corners[i] - corners[(i + 3) % 4];
  const cv::Point2d out = corners[(i + 1) % 4] - corners[i];
  const double lengths = std::hypot(in.x, in.y) * std::hypot(out.x, out.y);
  return lengths > 0.0 ? in.cross(out) / lengths : 0.0;
}

}  // namespace

std::string mistake_in_corners(std::span<const cv::Point2d> corners) {
  if (corners.size() != 4) {
    return fmt::format("{} corner{} given, {}", corners.size(), corners.size() == 1 ? "" : "s",
                       kExpected);
  }
  for (const cv::Point2d& corner : corners) {
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) {
      return fmt::format("a corner is not finite, {}", kExpected);
    }
  }
  std::array<double, 4> turns;
  for (std::size_t i = 0; i < 4; ++i) turns[i] = turn_at(corners, i);

  // Nearly straight corners would make the homography blow up long before it is singular.
  constexpr double kMinTurn = 1e-3;
  if (std::ranges::any_of(turns, [](double t) { return std::abs(t) < kMinTurn; })) {
    return fmt::format("three corners lie on one line or two coincide, {}", kExpected);
  }
  const auto clockwise = std::ranges::count_if(turns, [](double t) { return t > 0.0; });
  if (clockwise == 0) return fmt::format("the corners run counter-clockwise, {}", kExpected);
  if (clockwise != 4) {
    return fmt::format("the corners make no convex field (two may be swapped), {}", kExpected);
  }
  const cv::Point2d top = corners[1] - corners[0];
  if (top.x < std::abs(top.y)) {
    return fmt::format("the corners start at another corner than the top-left one, {}; to turn "
                       "the field by 180 degrees use half_time",
                       kExpected);
  }
  return {};
}

}  // namespace maggic
