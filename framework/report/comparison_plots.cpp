#include "report/comparison_plots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr std::size_t kMostPoints = 400;  // more than pixels across would only blacken the line

using Value = std::function<double(const FramePoint&)>;

/// Means over stretches of `stretch` frames; what is not known does not count.
std::vector<cv::Point2d> points_of(const std::vector<FrameRow>& rows, std::size_t pipeline,
                                   std::size_t stretch, const Value& value) {
  std::vector<cv::Point2d> points;
  for (std::size_t begin = 0; begin < rows.size(); begin += stretch) {
    const std::size_t end = std::min(begin + stretch, rows.size());
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double v = value(rows[i].points[pipeline]);
      if (std::isnan(v)) continue;
      sum += v;
      ++count;
    }
    const double x =
        (static_cast<double>(rows[begin].sequence) + static_cast<double>(rows[end - 1].sequence)) /
        2.0;
    points.emplace_back(x, count == 0 ? std::numeric_limits<double>::quiet_NaN()
                                      : sum / static_cast<double>(count));
  }
  return points;
}

/// Draws one number against the frames, a line a pipeline.
class FramePlots {
 public:
  explicit FramePlots(const ComparisonReport& report)
      : report_(report), stretch_((report.rows.size() + kMostPoints - 1) / kMostPoints) {
    stretch_ = std::max<std::size_t>(stretch_, 1);
  }

  LinePlot plot(std::string title, std::string unit, const Value& value,
                std::size_t first_pipeline = 0) const {
    LinePlot plot;
    plot.title = std::move(title);
    plot.size_px = {880, 320};
    plot.x_axis.label = stretch_ == 1 ? "frame" : fmt::format("frame, means of {}", stretch_);
    plot.y_axis.unit = std::move(unit);
    plot.y_axis.min = 0.0;
    for (std::size_t i = first_pipeline; i < report_.pipelines.size(); ++i) {
      plot.series.push_back({report_.pipelines[i].name, series_color(i),
                             points_of(report_.rows, i, stretch_, value), i});
    }
    return plot;
  }

 private:
  const ComparisonReport& report_;
  std::size_t stretch_;
};

Value time_of(Step step) {
  return [step](const FramePoint& point) { return point.step_ms[static_cast<std::size_t>(step)]; };
}

}  // namespace

DisplayColor series_color(std::size_t pipeline) {
  // Okabe and Ito's colours, but for yellow and the light ones, which are weak on white.
  constexpr std::array<DisplayColor, 6> kColors{
      {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {90, 90, 90}, {230, 159, 0}}};
  return kColors[pipeline % kColors.size()];
}

std::vector<std::string> comparison_plots(const ComparisonReport& report) {
  const FramePlots plots(report);
  std::vector<std::string> svgs;
  const Value error = [](const FramePoint& point) { return point.position_error_mm; };
  LinePlot errors =
      report.has_truth
          ? plots.plot("Distance from the truth, robots and ball", "mm", error)
          : plots.plot("Distance from the first pipeline's, robots and ball", "mm", error, 1);
  errors.y_axis.label = "RMSE";
  svgs.push_back(to_svg(errors));

  LinePlot seen = plots.plot("Objects seen: robots and ball", "",
                             [](const FramePoint& point) { return point.objects_seen; });
  seen.y_axis.label = "objects";
  svgs.push_back(to_svg(seen));

  PlotGrid times;
  times.title = "Time a frame";
  times.columns = 2;
  for (const Step step : {Step::kSegment, Step::kBlobs, Step::kTrack}) {
    times.plots.push_back(plots.plot(std::string(name_of(step)), "ms", time_of(step)));
  }
  times.plots.push_back(plots.plot("frame path: the sum of these", "ms", [](const FramePoint& p) {
    return time_of(Step::kSegment)(p) + time_of(Step::kBlobs)(p) + time_of(Step::kTrack)(p);
  }));
  for (LinePlot& plot : times.plots) {
    plot.size_px = {470, 260};
    plot.y_axis.label = "time";
  }
  svgs.push_back(to_svg(times));
  return svgs;
}

}  // namespace maggic
