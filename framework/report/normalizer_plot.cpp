#include "maggic/normalizer_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace maggic {
namespace {

const cv::Size kPanelSize(430, 390);
constexpr int kPlaneSteps = 8;
constexpr int kHueSteps = 16;
constexpr double kHues = 256.0;

using Rgb = DisplayColor;

Rgb normalized(const ColorNormalizer& normalizer, const Rgb& color) {
  const std::array<std::uint8_t, 1> b{color.blue}, g{color.green}, r{color.red};
  std::array<std::uint8_t, 1> nb{}, ng{}, nr{};
  normalizer.normalize({b, g, r}, {nb, ng, nr});
  return {nr[0], ng[0], nb[0]};
}

/// Hue in 1/256 of the circle, saturation and value 0 … 255, all fractional.
struct Hsv {
  double hue = 0.0;
  double saturation = 0.0;
  double value = 0.0;
};

Hsv hsv_of(const Rgb& color) {
  const double r = color.red;
  const double g = color.green;
  const double b = color.blue;
  const double value = std::max({r, g, b});
  const double spread = value - std::min({r, g, b});
  if (spread == 0.0) return {0.0, 0.0, value};
  const double sixth = value == r   ? (g - b) / spread
                       : value == g ? 2.0 + (b - r) / spread
                                    : 4.0 + (r - g) / spread;
  return {std::fmod(sixth + 6.0, 6.0) * kHues / 6.0, 255.0 * spread / value, value};
}

Rgb rgb_of(const Hsv& hsv) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hsv.hue * 6.0 / kHues, 6.0);
    const double part = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(
        std::lround(hsv.value * (1.0 - hsv.saturation / 255.0 * part)));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

LinePlot panel(std::string title, PlotAxis x_axis, PlotAxis y_axis) {
  LinePlot plot;
  plot.title = std::move(title);
  plot.x_axis = std::move(x_axis);
  plot.y_axis = std::move(y_axis);
  plot.size_px = kPanelSize;
  return plot;
}

LinePlot red_green_plane(const ColorNormalizer& normalizer, std::uint8_t blue) {
  LinePlot plot =
      panel(fmt::format("red and green at blue {}", blue),
            {"red", "8-bit steps", 0.0, 255.0, false}, {"green", "8-bit steps", 0.0, 255.0, false});
  const auto level = [](int step) {
    return static_cast<std::uint8_t>(std::lround(255.0 * step / kPlaneSteps));
  };
  for (int r = 0; r <= kPlaneSteps; ++r) {
    for (int g = 0; g <= kPlaneSteps; ++g) {
      const Rgb from{level(r), level(g), blue};
      const Rgb to = normalized(normalizer, from);
      plot.arrows.push_back(
          {cv::Point2d(from.red, from.green), cv::Point2d(to.red, to.green), from});
    }
  }
  return plot;
}

/// The hue the shorter way round the circle, which may lie beyond its ends.
double unwrapped(double hue, double from) { return from + std::remainder(hue - from, kHues); }

/// @param y the coordinate shown against hue. @param color_at what stands at a hue and such a `y`.
LinePlot hue_plane(const ColorNormalizer& normalizer, std::string title, PlotAxis y_axis,
                   double Hsv::*y, const std::vector<double>& levels, Hsv fixed) {
  LinePlot plot =
      panel(std::move(title), {"hue", "1/256 of the circle", 0.0, 256.0, false}, std::move(y_axis));
  for (int step = 0; step < kHueSteps; ++step) {
    for (const double level : levels) {
      fixed.hue = kHues * step / kHueSteps;
      fixed.*y = level;
      const Rgb color = rgb_of(fixed);
      const Hsv from = hsv_of(color);
      Hsv to = hsv_of(normalized(normalizer, color));
      if (to.saturation == 0.0) to.hue = from.hue;
      plot.arrows.push_back({{from.hue, from.*y}, {unwrapped(to.hue, from.hue), to.*y}, color});
    }
  }
  return plot;
}

}  // namespace

PlotGrid normalizer_plot(std::string_view name, const ColorNormalizer& normalizer) {
  PlotGrid grid;
  grid.title = fmt::format("Where the normalizer {} moves colours", name);
  grid.columns = 2;
  grid.plots = {red_green_plane(normalizer, 0), red_green_plane(normalizer, 64),
                hue_plane(normalizer, "hue and value at 60 % saturation",
                          {"value", "8-bit steps", 0.0, 255.0, false}, &Hsv::value,
                          {40.0, 80.0, 120.0, 160.0, 200.0, 240.0}, {0.0, 153.0, 0.0}),
                hue_plane(normalizer, "hue and saturation at value 200",
                          {"saturation", "8-bit steps", 0.0, 255.0, false}, &Hsv::saturation,
                          {30.0, 70.0, 110.0, 150.0, 190.0, 230.0}, {0.0, 0.0, 200.0})};
  return grid;
}

}  // namespace maggic
