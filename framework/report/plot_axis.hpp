#pragma once
/// From an axis' numbers to places along it.

#include <span>
#include <string>
#include <vector>

#include "maggic/svg_plot.hpp"

namespace maggic {

/// The part of the numbers an axis shows, with its ticks.
class AxisScale {
 public:
  /// @param values of everything drawn along the axis; those not drawable are passed over.
  /// @param about how many ticks there is room for.
  AxisScale(const PlotAxis& axis, std::span<const double> values, std::size_t about);

  bool is_drawable(double value) const;
  /// 0 at the low end, 1 at the high end, beyond outside. @param value drawable.
  double place(double value) const;
  /// Ascending, inside the axis.
  std::span<const double> ticks() const { return ticks_; }
  std::string tick_text(double tick) const;

 private:
  double low_ = 0.0;
  double high_ = 1.0;
  bool logarithmic_ = false;
  std::vector<double> ticks_;
  int decimals_ = 0;  ///< Of the texts; negative: as many as the number needs.
};

}  // namespace maggic
