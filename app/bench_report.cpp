#include "app/bench_report.hpp"

#include <chrono>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/milliseconds.hpp"
#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using Align = TextTable::Align;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kWidth = 200;
constexpr std::size_t kMebi = std::size_t{1} << 20;

/// Small ones keep their digits.
std::string ms(std::chrono::nanoseconds time) {
  const double value = in_ms(time);
  return fmt::format("{:.{}f}", value, value < 10.0 ? 4 : 2);
}

std::string times_of(std::chrono::nanoseconds time, std::chrono::nanoseconds yardstick) {
  if (yardstick.count() == 0) return "-";
  return fmt::format("{:.2f}", in_ms(time) / in_ms(yardstick));
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string title_of(const SpeedReport& report) {
  const MachineDescription& machine = report.machine;
  std::string text =
      fmt::format("{}: {} of {} × {} from {}", report.pipeline, counted(report.frames, "frame"),
                  report.frame_size_px.width, report.frame_size_px.height, report.source);
  if (report.frames_from_source < report.frames) {
    text += fmt::format(" ({} of them distinct)", report.frames_from_source);
  }
  text += fmt::format("\non {}, {}", machine.cpu, counted(machine.cores, "core"));
  if (machine.last_level_cache_bytes > 0) {
    text += fmt::format(", last level cache {} MiB", machine.last_level_cache_bytes / kMebi);
  }
  return text + fmt::format(", vector instructions {}\none frame by {}, search {}\n",
                            report.simd_target,
                            counted(static_cast<std::size_t>(report.scan.threads), "thread"),
                            name_of(report.scan.search));
}

std::string frame_path_text(const SpeedReport& report) {
  const FramePathSpeed& speed = report.frame_path;
  std::vector<Align> columns(6, Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  table.add({"cold, ms a frame", "min", "p50", "p99", "ns a pixel", "× floor"});
  const auto add = [&](std::string_view name, const DurationFigures& figures) {
    const double ns_a_pixel =
        static_cast<double>(figures.p50.count()) / report.frame_size_px.area();
    table.add({std::string(name), ms(figures.min), ms(figures.p50), ms(figures.p99),
               fmt::format("{:.3f}", ns_a_pixel), times_of(figures.p50, speed.floor.p50)});
  };
  add("floor", speed.floor);
  if (speed.plain_table) add("plain table: pixels → labels", *speed.plain_table);
  add("segment: pixels → runs", speed.segment);
  add("blobs: runs → blobs", speed.blobs);
  add("track: blobs → detections", speed.track);
  add("pixels → blobs", speed.pixels_to_blobs);
  add("pixels → detections", speed.pixels_to_detections);
  return table.to_string(kIndent, kWidth) +
         fmt::format(
             "  {:.0f} runs, {:.1f} blobs, {:.1f} robots a frame\n"
             "The floor reads every byte of the frame and writes one byte a pixel with vector\n"
             "instructions; the plain table looks every pixel up in 16 MiB of labels. Both, on\n"
             "one thread, and the frame path run in turn on each frame, caches evicted before\n"
             "each (all other figures: as they come). ns a pixel and × floor are of the medians.\n",
             speed.runs_a_frame, speed.blobs_a_frame, speed.robots_a_frame);
}

std::string table_text(const SpeedReport& report) {
  if (!report.table) return "no colour table: a stage of this pipeline needs the picture\n";
  const TableSpeed& speed = *report.table;
  std::vector<Align> columns(5, Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  table.add({"colour table, ms", "min", "p50", "p99", "× copy"});
  const auto add = [&](std::string name, const DurationFigures& figures) {
    table.add({std::move(name), ms(figures.min), ms(figures.p50), ms(figures.p99),
               times_of(figures.p50, speed.memcpy_16mib.p50)});
  };
  add("compiled on 1 thread", speed.compile);
  add(fmt::format("compiled on {}", counted(report.threads, "thread")), speed.compile_in_threads);
  add(report.update + ", 1 thread", speed.update);
  add("copy of 16 MiB (memcpy)", speed.memcpy_16mib);
  return table.to_string(kIndent, kWidth);
}

std::string rates_text(const SpeedReport& report) {
  const LatencySpeed& latency = report.latency;
  const Throughput& rates = report.throughput;
  std::string text =
      fmt::format("throughput  {:.0f} frames a second on 1 thread\n", rates.one_thread_fps);
  if (report.threads > 1) {
    text += fmt::format(
        "            {:.0f} frames a second, {} threads sharing each frame\n"
        "            {:.0f} frames a second, {} pipelines on a thread each\n",
        rates.threads_fps, report.threads, rates.pipelines_fps, report.threads);
  }
  text += fmt::format(
      "latency     {} ms (p50), {} ms (p99) from capture to detections through the run loop,\n"
      "            frames coming at the source's pace of {:.1f} a second, {} of {} dropped\n",
      ms(latency.capture_to_detection.p50), ms(latency.capture_to_detection.p99),
      latency.frames_per_second, latency.dropped, latency.frames);
  return text;
}

}  // namespace

std::string_view name_of(ScanParameters::Search search) {
  return search == ScanParameters::Search::kPredicted ? "predicted" : "full";
}

std::string speed_text(const SpeedReport& report) {
  return fmt::format("{}\n{}\n{}\n{}", title_of(report), frame_path_text(report),
                     table_text(report), rates_text(report));
}

}  // namespace maggic::app
