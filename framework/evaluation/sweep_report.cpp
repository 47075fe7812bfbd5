#include "maggic/sweep_report.hpp"

#include <iterator>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr DisplayColor kBackgroundLine{90, 90, 90};

/// In the order of the palette; those without a pixel are left out.
std::vector<Label> labels_in(const LabelSweep& sweep) {
  std::vector<Label> labels;
  for (std::size_t label = 0; label < sweep.labels(); ++label) {
    if (sweep.pixels(static_cast<Label>(label)) > 0) labels.push_back(static_cast<Label>(label));
  }
  return labels;
}

}  // namespace

LinePlot plot_of(const NamedSweep& sweep, const Palette& palette, double share, cv::Size size_px) {
  LinePlot plot;
  plot.title = sweep.normalizer;
  plot.x_axis = {"gray threshold", "8-bit steps", 0.0, 255.0, false};
  plot.y_axis = {"pixels labelled right", "%", 0.0, 100.0, false};
  plot.size_px = size_px;
  for (const Label label : labels_in(sweep.sweep)) {
    PlotSeries series;
    series.name = palette.name(label);
    series.color = label == kBackground ? kBackgroundLine : palette.display_color(label);
    series.style = label;
    for (std::size_t t = 0; t < LabelSweep::kThresholds; ++t) {
      series.points.emplace_back(static_cast<double>(t), 100.0 * sweep.sweep.share(label, t));
    }
    plot.series.push_back(std::move(series));
  }
  if (const auto usable = sweep.sweep.usable(share)) {
    plot.bands.push_back(
        {static_cast<double>(usable->first), static_cast<double>(usable->last),
         fmt::format("all ≥ {:.4g} %: {} … {}", 100.0 * share, usable->first, usable->last)});
  }
  return plot;
}

std::string csv_of(const std::vector<NamedSweep>& sweeps, const Palette& palette) {
  std::string csv = "normalizer,gray_threshold";
  if (sweeps.empty()) return csv + '\n';
  const std::vector<Label> labels = labels_in(sweeps.front().sweep);
  for (const Label label : labels) csv += fmt::format(",{}_percent", palette.name(label));
  csv += '\n';
  for (const NamedSweep& named : sweeps) {
    for (std::size_t t = 0; t < LabelSweep::kThresholds; ++t) {
      csv += fmt::format("{},{}", named.normalizer, t);
      for (const Label label : labels) {
        fmt::format_to(std::back_inserter(csv), ",{:.3f}", 100.0 * named.sweep.share(label, t));
      }
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace maggic
