#pragma once
/// Line plots as self-contained SVG: no script, no font, no identifier, so that any number of them
/// can stand in one HTML page. The same plot gives the same bytes on every run.
///
///     LinePlot plot;
///     plot.title = "Pixels labelled right";
///     plot.x_axis = {"gray threshold", "8-bit steps", 0.0, 255.0};
///     plot.y_axis = {"share", "%", 0.0, 100.0};
///     plot.series.push_back({"orange", {255, 120, 0}, points});
///     write_file_atomically("share.svg", to_svg(plot));

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/palette.hpp"

namespace maggic {

/// One line of a plot. Colour is never its only sign: dash pattern and marker follow from `style`.
struct PlotSeries {
  std::string name;    ///< For the legend; series without one are not listed there.
  DisplayColor color;  ///< Very light colours are darkened until they stand out from white.
  /// In the axes' units, in the order they are joined. A point that is not finite, or not above 0
  /// on a logarithmic axis, leaves a gap; a point between two gaps is a lone marker.
  std::vector<cv::Point2d> points;
  /// Which dash and marker, counted round; left out: the place among the plot's series. Give it
  /// where one meaning must look the same in several plots.
  std::optional<std::size_t> style;
};

/// What is written along an axis, and which part of the numbers it shows.
struct PlotAxis {
  std::string label;
  std::string unit;           ///< Put in brackets behind the label; may be empty.
  std::optional<double> min;  ///< Left out: a tick at or below the smallest number shown.
  std::optional<double> max;  ///< Left out: a tick at or above the largest.
  bool logarithmic = false;   ///< Decades; ends that are not above 0 are as if left out.
};

/// A stretch of the x axis with a coloured ground and a name.
struct PlotBand {
  double from = 0.0;
  double to = 0.0;
  std::string name;  ///< Written at its top; may be empty.
  DisplayColor color{120, 170, 120};
};

struct LinePlot {
  std::string title;
  PlotAxis x_axis;
  PlotAxis y_axis;
  std::vector<PlotSeries> series;
  std::vector<PlotBand> bands;
  cv::Size size_px{640, 400};  ///< Of the whole picture; at least 200 × 150 is drawn.
};

/// Small multiples: plots side by side under one title, with one legend for all. The size of the
/// first plot, less its legend, is that of every panel; own axes stay.
struct PlotGrid {
  std::string title;
  std::vector<LinePlot> plots;  ///< Row by row.
  std::size_t columns = 2;      ///< 0 counts as 1.
};

/// Text is escaped; bytes that are not UTF-8 and control characters become U+FFFD. A plot without a
/// single point is drawn with axes from 0 to 1.
std::string to_svg(const LinePlot& plot);
std::string to_svg(const PlotGrid& grid);

/// Round numbers (1, 2 or 5 times a power of ten apart) for an axis: ascending, the first at or
/// below `low`, the last at or above `high`, about `about` of them and at least two.
/// @param low,high finite, in either order; beyond ±1e300 they count as that.
std::vector<double> axis_ticks(double low, double high, std::size_t about);

/// The same for a logarithmic axis: powers of ten. @param low,high above 0.
std::vector<double> decade_ticks(double low, double high);

}  // namespace maggic
