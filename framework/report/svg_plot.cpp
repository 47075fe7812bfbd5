#include "maggic/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "report/plot_axis.hpp"
#include "report/svg_canvas.hpp"

namespace maggic {
namespace {

constexpr double kTitleSize = 14.0;
constexpr double kTextSize = 11.0;
constexpr double kMarkerRadius = 3.2;
constexpr double kMarkerDistance = 56.0;  // along x, so that markers do not hide the line
constexpr double kLegendRow = 18.0;
constexpr double kLegendLine = 30.0;
constexpr double kDrawnTolerance = 0.1;  // px a point may be off the line that leaves it out
constexpr double kClipRoom = 4.0;        // a line along the border is not cut in half
const cv::Size kSmallest{200, 150};

constexpr std::array<std::string_view, 5> kDashes{"", "6 3", "2 2", "9 3 2 3", "12 4"};
constexpr std::size_t kMarkers = 7;  // coprime to the dashes: 35 pairs before one comes again

/// Yellow and its like cannot be seen on white.
DisplayColor visible(DisplayColor color) {
  constexpr double kBrightest = 150.0;
  const double luma = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
  if (luma <= kBrightest) return color;
  const auto darker = [&](std::uint8_t channel) {
    return static_cast<std::uint8_t>(channel * kBrightest / luma);
  };
  return {darker(color.red), darker(color.green), darker(color.blue)};
}

void draw_marker(SvgCanvas& canvas, cv::Point2d at, std::size_t marker, const std::string& color) {
  const SvgCanvas::Stroke stroke{color, 1.2};
  const double r = kMarkerRadius;
  const auto polygon = [&](std::initializer_list<cv::Point2d> offsets, std::string_view fill) {
    std::vector<cv::Point2d> corners;
    for (const cv::Point2d& offset : offsets) corners.push_back(at + r * offset);
    canvas.polygon(corners, fill, stroke);
  };
  switch (marker % kMarkers) {
    case 0: canvas.circle(at, 0.85 * r, color, stroke); break;
    case 1: polygon({{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}, color); break;
    case 2: polygon({{0.0, -1.1}, {1.0, 0.8}, {-1.0, 0.8}}, color); break;
    case 3: polygon({{0.0, -1.2}, {1.2, 0.0}, {0.0, 1.2}, {-1.2, 0.0}}, "#ffffff"); break;
    case 4: canvas.circle(at, r, "#ffffff", stroke); break;
    case 5: polygon({{0.0, 1.1}, {1.0, -0.8}, {-1.0, -0.8}}, "#ffffff"); break;
    default: {
      const cv::Point2d down(0.9 * r, 0.9 * r);
      const cv::Point2d up(0.9 * r, -0.9 * r);
      canvas.line(at - down, at + down, {color, 1.6});
      canvas.line(at - up, at + up, {color, 1.6});
    }
  }
}

/// How one meaning is drawn everywhere.
struct LineStyle {
  std::string name;
  std::string color;
  std::size_t style = 0;

  std::string_view dashes() const { return kDashes[style % kDashes.size()]; }
  friend bool operator==(const LineStyle&, const LineStyle&) = default;
};

LineStyle style_of(const LinePlot& plot, std::size_t series) {
  const PlotSeries& s = plot.series[series];
  return {s.name, svg_color(visible(s.color)), s.style.value_or(series)};
}

/// Names with their signs in as many rows as they need.
class Legend {
 public:
  void add(const LinePlot& plot) {
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      LineStyle style = style_of(plot, i);
      if (!style.name.empty() && std::ranges::find(entries_, style) == entries_.end()) {
        entries_.push_back(std::move(style));
      }
    }
  }

  /// @return the height it takes in a picture of this width.
  double height(double width) const {
    return layout(width, [](auto&&...) {});
  }

  void draw(SvgCanvas& canvas, double top, double width) const {
    layout(width, [&](const LineStyle& entry, cv::Point2d at) {
      const cv::Point2d left(at.x, top + at.y + kLegendRow / 2.0);
      canvas.line(left, left + cv::Point2d(kLegendLine, 0.0), {entry.color, 1.8, entry.dashes()});
      draw_marker(canvas, left + cv::Point2d(kLegendLine / 2.0, 0.0), entry.style, entry.color);
      canvas.text(left + cv::Point2d(kLegendLine + 6.0, kTextSize / 3.0), entry.name,
                  {.size = kTextSize});
    });
  }

 private:
  template <class Place>
  double layout(double width, Place place) const {
    constexpr double kMargin = 14.0;
    cv::Point2d at(kMargin, 0.0);
    for (const LineStyle& entry : entries_) {
      const double entry_width = kLegendLine + 24.0 + text_width(entry.name, kTextSize);
      if (at.x > kMargin && at.x + entry_width > width - kMargin) at = {kMargin, at.y + kLegendRow};
      place(entry, at);
      at.x += entry_width;
    }
    return entries_.empty() ? 0.0 : at.y + kLegendRow + 6.0;
  }

  std::vector<LineStyle> entries_;
};

/// Leaves out points that lie on the line between their neighbours (Douglas and Peucker, 1973).
std::vector<cv::Point2d> simplified(std::span<const cv::Point2d> points) {
  std::vector<bool> is_kept(points.size(), false);
  is_kept.front() = is_kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, points.size() - 1}};
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    const cv::Point2d along = points[last] - points[first];
    const double length = std::hypot(along.x, along.y);
    double farthest = kDrawnTolerance;
    std::size_t split = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const cv::Point2d offset = points[i] - points[first];
      const double distance =
          length > 0.0 ? std::abs(along.cross(offset)) / length : std::hypot(offset.x, offset.y);
      if (distance > farthest) {
        farthest = distance;
        split = i;
      }
    }
    if (split == 0) continue;
    is_kept[split] = true;
    stretches.emplace_back(first, split);
    stretches.emplace_back(split, last);
  }
  std::vector<cv::Point2d> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_kept[i]) kept.push_back(points[i]);
  }
  return kept;
}

/// Axes, grid and lines of one plot in a box of the picture, without a legend.
class Panel {
 public:
  Panel(const LinePlot& plot, cv::Rect2d box)
      : plot_(plot),
        box_(box),
        y_(plot.y_axis, values_along([](cv::Point2d p) { return p.y; }),
           ticks_for(box.height, 45.0)),
        x_(plot.x_axis, values_along([](cv::Point2d p) { return p.x; }),
           ticks_for(box.width, 70.0)) {
    double widest = 0.0;
    for (const double tick : y_.ticks()) {
      widest = std::max(widest, text_width(y_.tick_text(tick), kTextSize));
    }
    const bool has_names =
        std::ranges::any_of(plot.bands, [](const PlotBand& band) { return !band.name.empty(); });
    const double left = 18.0 + kTextSize + widest;
    const double top = (plot.title.empty() ? 10.0 : 28.0) + (has_names ? 14.0 : 0.0);
    area_ = {box.x + left, box.y + top, box.width - left - 16.0, box.height - top - 44.0};
  }

  void draw(SvgCanvas& canvas) const {
    draw_bands(canvas);
    draw_axes(canvas);
    canvas.begin_clip({area_.x - kClipRoom, area_.y - kClipRoom, area_.width + 2.0 * kClipRoom,
                       area_.height + 2.0 * kClipRoom});
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw_series(canvas, i);
    canvas.end_clip();
  }

 private:
  static std::size_t ticks_for(double length, double distance) {
    return static_cast<std::size_t>(std::max(3.0, length / distance));
  }

  template <class Coordinate>
  std::vector<double> values_along(Coordinate coordinate) const {
    std::vector<double> values;
    for (const PlotSeries& series : plot_.series) {
      for (const cv::Point2d& point : series.points) values.push_back(coordinate(point));
    }
    return values;
  }

  cv::Point2d place(cv::Point2d point) const {
    // Far beyond the picture is as good as farther: keeps the numbers short.
    constexpr double kFar = 1e4;
    return {std::clamp(area_.x + x_.place(point.x) * area_.width, -kFar, kFar),
            std::clamp(area_.br().y - y_.place(point.y) * area_.height, -kFar, kFar)};
  }

  void draw_bands(SvgCanvas& canvas) const {
    for (const PlotBand& band : plot_.bands) {
      if (!x_.is_drawable(band.from) || !x_.is_drawable(band.to)) continue;
      const auto [from, to] = std::minmax(
          {std::clamp(x_.place(band.from), 0.0, 1.0), std::clamp(x_.place(band.to), 0.0, 1.0)});
      canvas.rectangle(
          {area_.x + from * area_.width, area_.y, (to - from) * area_.width, area_.height},
          svg_color(band.color), 0.22);
      canvas.text({area_.x + 0.5 * (from + to) * area_.width, area_.y - 4.0}, band.name,
                  {.size = kTextSize - 1.0, .anchor = SvgCanvas::Anchor::kMiddle});
    }
  }

  void draw_axes(SvgCanvas& canvas) const {
    using Anchor = SvgCanvas::Anchor;
    const SvgCanvas::Stroke grid{"#e2e2e2", 1.0};
    for (const double tick : x_.ticks()) {
      const double x = area_.x + x_.place(tick) * area_.width;
      canvas.line({x, area_.y}, {x, area_.br().y + 4.0}, grid);
      canvas.text({x, area_.br().y + 4.0 + kTextSize}, x_.tick_text(tick),
                  {.size = kTextSize, .anchor = Anchor::kMiddle});
    }
    for (const double tick : y_.ticks()) {
      const double y = area_.br().y - y_.place(tick) * area_.height;
      canvas.line({area_.x - 4.0, y}, {area_.br().x, y}, grid);
      canvas.text({area_.x - 7.0, y + kTextSize / 3.0}, y_.tick_text(tick),
                  {.size = kTextSize, .anchor = Anchor::kEnd});
    }
    canvas.frame(area_, {"#777777", 1.0});
    const auto named = [](const PlotAxis& axis) {
      return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
    };
    canvas.text({area_.x + area_.width / 2.0, box_.br().y - 8.0}, named(plot_.x_axis),
                {.size = kTextSize, .anchor = Anchor::kMiddle});
    canvas.text({box_.x + 6.0 + kTextSize, area_.y + area_.height / 2.0}, named(plot_.y_axis),
                {.size = kTextSize, .anchor = Anchor::kMiddle, .upwards = true});
    canvas.text({area_.x + area_.width / 2.0, box_.y + 8.0 + kTitleSize * 0.75}, plot_.title,
                {.size = kTitleSize - 1.0, .anchor = Anchor::kMiddle, .bold = true});
  }

  void draw_series(SvgCanvas& canvas, std::size_t series) const {
    const LineStyle style = style_of(plot_, series);
    std::vector<cv::Point2d> stretch;
    for (const cv::Point2d& point : plot_.series[series].points) {
      if (x_.is_drawable(point.x) && y_.is_drawable(point.y)) {
        stretch.push_back(place(point));
      } else {
        draw_stretch(canvas, stretch, style);
        stretch.clear();
      }
    }
    draw_stretch(canvas, stretch, style);
  }

  void draw_stretch(SvgCanvas& canvas, std::span<const cv::Point2d> points,
                    const LineStyle& style) const {
    if (points.empty()) return;
    if (points.size() > 1) canvas.polyline(simplified(points), {style.color, 1.8, style.dashes()});
    // Lines that lie on each other show their markers in turn.
    constexpr double kShift = 17.0;
    double next =
        points.size() == 1
            ? points[0].x
            : area_.x + std::fmod(static_cast<double>(style.style) * kShift, kMarkerDistance);
    for (const cv::Point2d& point : points) {
      if (point.x < next && points.size() > 3) continue;
      draw_marker(canvas, point, style.style, style.color);
      while (next <= point.x) next += kMarkerDistance;
    }
  }

  const LinePlot& plot_;
  cv::Rect2d box_;
  AxisScale y_;
  AxisScale x_;
  cv::Rect2d area_;
};

cv::Size usable(cv::Size size) {
  return {std::max(size.width, kSmallest.width), std::max(size.height, kSmallest.height)};
}

}  // namespace

std::string to_svg(const LinePlot& plot) {
  Legend legend;
  legend.add(plot);
  const cv::Size size = usable(plot.size_px);
  const double height = std::max(size.height - legend.height(size.width), 110.0);
  SvgCanvas canvas({size.width, static_cast<int>(height + legend.height(size.width))});
  Panel(plot, {0.0, 0.0, static_cast<double>(size.width), height}).draw(canvas);
  legend.draw(canvas, height, size.width);
  return canvas.finish();
}

std::string to_svg(const PlotGrid& grid) {
  Legend legend;
  for (const LinePlot& plot : grid.plots) legend.add(plot);
  const cv::Size panel =
      usable(grid.plots.empty() ? LinePlot().size_px : grid.plots.front().size_px);
  const std::size_t columns =
      std::clamp<std::size_t>(grid.columns, 1, std::max<std::size_t>(grid.plots.size(), 1));
  const std::size_t rows = (grid.plots.size() + columns - 1) / columns;
  const int width = panel.width * static_cast<int>(columns);
  const double top = grid.title.empty() ? 0.0 : 30.0;
  const double legend_top = top + static_cast<double>(rows) * panel.height;
  SvgCanvas canvas({width, static_cast<int>(legend_top + legend.height(width) + 4.0)});
  canvas.text({width / 2.0, 22.0}, grid.title,
              {.size = kTitleSize + 1.0, .anchor = SvgCanvas::Anchor::kMiddle, .bold = true});
  for (std::size_t i = 0; i < grid.plots.size(); ++i) {
    const cv::Point2d corner(static_cast<double>(i % columns) * panel.width,
                             top + static_cast<double>(i / columns) * panel.height);
    Panel(grid.plots[i], {corner, cv::Size2d(panel)}).draw(canvas);
  }
  legend.draw(canvas, legend_top, width);
  return canvas.finish();
}

}  // namespace maggic
