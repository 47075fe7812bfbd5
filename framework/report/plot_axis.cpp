#include "report/plot_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr double kLargest = 1e300;
constexpr double kSmallest = 1.0 / kLargest;
constexpr double kPlainFrom = 1e-3;  // smaller and larger numbers are written with an exponent
constexpr double kPlainTo = 1e6;

/// The nearest of 1, 2, 5 × a power of ten, by its ratio to `wanted`.
double round_step(double wanted) {
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power * std::numbers::sqrt2 >= wanted) return digit * power;
  }
  return 10.0 * power;
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, std::size_t about) {
  if (low > high) std::swap(low, high);
  low = std::clamp(low, -kLargest, kLargest);
  high = std::clamp(high, -kLargest, kLargest);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= std::max(1e-9 * size, kSmallest)) {  // nothing to tell apart: make room
    const double room = size > kSmallest ? 0.5 * size : 0.5;
    low = std::max(low - room, -kLargest);
    high = std::min(high + room, kLargest);
  }
  const double intervals = static_cast<double>(std::clamp<std::size_t>(about, 2, 50) - 1);
  const double step = round_step(high / intervals - low / intervals);
  // Multiples of the step, not sums: no error adds up.
  double first = std::floor(low / step);
  while (first * step > low) first -= 1.0;
  std::vector<double> ticks;
  for (double i = first; ticks.empty() || ticks.back() < high; i += 1.0) {
    ticks.push_back(i * step + 0.0);
  }
  return ticks;
}

std::vector<double> decade_ticks(double low, double high) {
  if (low > high) std::swap(low, high);
  low = std::clamp(low, kSmallest, kLargest);
  high = std::clamp(high, kSmallest, kLargest);
  int first = static_cast<int>(std::floor(std::log10(low)));
  if (std::pow(10.0, first) > low) --first;
  std::vector<double> ticks;
  for (int power = first; ticks.size() < 2 || ticks.back() < high; ++power) {
    ticks.push_back(std::pow(10.0, power));
  }
  return ticks;
}

AxisScale::AxisScale(const PlotAxis& axis, std::span<const double> values, std::size_t about)
    : logarithmic_(axis.logarithmic) {
  double low = logarithmic_ ? 0.1 : 0.0;
  double high = 1.0;
  bool is_first = true;
  for (const double value : values) {
    if (!is_drawable(value)) continue;
    low = is_first ? value : std::min(low, value);
    high = is_first ? value : std::max(high, value);
    is_first = false;
  }
  const auto given = [this](const std::optional<double>& end) { return end && is_drawable(*end); };
  if (given(axis.min)) low = *axis.min;
  if (given(axis.max)) high = *axis.max;
  ticks_ = logarithmic_ ? decade_ticks(low, high) : axis_ticks(low, high, about);
  low_ = given(axis.min) ? *axis.min : ticks_.front();
  high_ = given(axis.max) ? *axis.max : ticks_.back();
  if (!(low_ < high_)) {  // the wrong way round, or one point: as if left out
    low_ = ticks_.front();
    high_ = ticks_.back();
  }
  const double step = ticks_[1] - ticks_[0];
  const double room = 1e-9 * (high_ / 2.0 - low_ / 2.0);
  std::erase_if(ticks_, [&](double t) { return t < low_ - room || t > high_ + room; });
  const double size = std::max(std::abs(low_), std::abs(high_));
  const bool is_plain = !logarithmic_ && size < kPlainTo && step >= kPlainFrom;
  decimals_ = is_plain ? std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))) : -1;
}

bool AxisScale::is_drawable(double value) const {
  return std::isfinite(value) && std::abs(value) <= kLargest && (!logarithmic_ || value > 0.0);
}

double AxisScale::place(double value) const {
  if (logarithmic_) {
    return (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_));
  }
  // Halved, because the ends may be the largest numbers there are.
  return (value / 2.0 - low_ / 2.0) / (high_ / 2.0 - low_ / 2.0);
}

std::string AxisScale::tick_text(double tick) const {
  return decimals_ < 0 ? fmt::format("{:.6g}", tick) : fmt::format("{:.{}f}", tick, decimals_);
}

}  // namespace maggic
