#include "app/summary.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/milliseconds.hpp"
#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using Align = TextTable::Align;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kWidth = 200;

std::string ms(std::chrono::nanoseconds t) {
  return fmt::format("{:.3f}", in_ms(t));
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string found_text(const Found& found) {
  const double frames = static_cast<double>(found.frames);
  return fmt::format("found  {:.1f} robots a frame, a ball in {:.1f} % of frames\n",
                     static_cast<double>(found.robots) / frames,
                     100.0 * static_cast<double>(found.balls) / frames);
}

std::string times_text(const StepStatistics& times) {
  TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight});
  table.add({"ms a frame", "mean", "p50", "p99", "max"});
  const auto add = [&](std::string_view name, const DurationHistogram& h) {
    table.add(
        {std::string(name), ms(h.mean()), ms(h.quantile(0.5)), ms(h.quantile(0.99)), ms(h.max())});
  };
  for (const Step step : {Step::kRead, Step::kSegment, Step::kBlobs, Step::kTrack}) {
    add(name_of(step), times.of(step));
  }
  add("frame path", times.frame_path());
  return table.to_string(kIndent, kWidth);
}

std::string sinks_text(const std::vector<SinkSummary>& sinks) {
  TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
  for (const SinkSummary& sink : sinks) {
    std::string rest = "frames";
    if (sink.dropped > 0) rest += fmt::format(", {} dropped", sink.dropped);
    if (sink.failed > 0) rest += fmt::format(", {} failed", sink.failed);
    if (!sink.first_error.empty()) rest += ": " + sink.first_error;
    table.add({sink.name, std::to_string(sink.written), std::move(rest)});
  }
  return table.to_string(kIndent, kWidth);
}

std::string truth_text(const Scorecard& truth) {
  TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
  const auto of = [](std::uint64_t part, std::uint64_t whole) {
    return fmt::format("({} of {})", part, whole);
  };
  const auto largest = [](const ErrorDistribution& error, std::string_view unit) {
    return fmt::format("(largest {:.2f} {})", error.max(), unit);
  };
  const auto a_frame = [&](std::uint64_t count) {
    return fmt::format("{:.3f} a frame",
                       static_cast<double>(count) / static_cast<double>(truth.frames()));
  };
  const ObjectTally robots = truth.robots();
  const ObjectTally& ball = truth.ball();
  table.add({"robots found", percent(robots.seen, robots.frames), of(robots.seen, robots.frames)});
  table.add({"right team and id", percent(robots.right_identity, robots.frames),
             of(robots.right_identity, robots.frames)});
  table.add({"false robots", a_frame(truth.false_robots()), ""});
  table.add({"robot position RMSE", fmt::format("{:.2f} mm", robots.position_mm.rmse()),
             largest(robots.position_mm, "mm")});
  table.add({"robot heading RMSE", fmt::format("{:.2f} deg", robots.heading_deg.rmse()),
             largest(robots.heading_deg, "deg")});
  table.add({"ball found", percent(ball.seen, ball.frames), of(ball.seen, ball.frames)});
  table.add({"false balls", a_frame(truth.false_balls()), ""});
  table.add({"ball position RMSE", fmt::format("{:.2f} mm", ball.position_mm.rmse()),
             largest(ball.position_mm, "mm")});
  return table.to_string(kIndent, kWidth);
}

}  // namespace

void Found::add(const Detections& detections) {
  const auto seen = [](const auto& object) { return object.state == TrackState::kSeen; };
  ++frames;
  robots += static_cast<std::uint64_t>(std::ranges::count_if(detections.robots, seen));
  if (detections.ball && seen(*detections.ball)) ++balls;
}

std::string summary_text(const RunSummary& summary, const Found& found, const Scorecard& truth,
                         double elapsed_s) {
  const double rate = elapsed_s > 0.0 ? static_cast<double>(summary.processed) / elapsed_s : 0.0;
  std::string text =
      fmt::format("{} frames in {:.1f} s ({:.1f} fps), {} dropped, {} skipped", summary.processed,
                  elapsed_s, rate, summary.dropped, summary.skipped);
  if (summary.failed > 0) text += fmt::format(", {} failed", summary.failed);
  text += '\n';
  if (!summary.first_error.empty()) text += fmt::format("first error: {}\n", summary.first_error);
  if (summary.taken() == 0) text += "no frame ever came from the source\n";
  if (found.frames > 0) text += found_text(found);
  if (summary.processed > 0) text += '\n' + times_text(summary.times);
  if (summary.table_compile_time.count() > 0) {
    text += fmt::format("\ncolour table compiled in {} ms before the run\n",
                        ms(summary.table_compile_time));
  }
  if (!summary.sinks.empty()) text += "\noutputs\n" + sinks_text(summary.sinks);
  if (truth.frames() > 0) {
    text += fmt::format("\nagainst the ground truth of {} frames\n{}", truth.frames(),
                        truth_text(truth));
  }
  return text;
}

}  // namespace maggic::app
