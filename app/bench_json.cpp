#include <chrono>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/bench_report.hpp"
#include "app/milliseconds.hpp"
#include "app/score_json.hpp"

namespace maggic::app {
namespace {

OrderedJson to_json(const DurationFigures& figures) {
  return {{"min", in_ms(figures.min)}, {"p50", in_ms(figures.p50)}, {"p99", in_ms(figures.p99)}};
}

OrderedJson to_json(const std::optional<DurationFigures>& figures) {
  return figures ? to_json(*figures) : OrderedJson();
}

double rounded(double value, double steps_a_unit) {
  return std::round(value * steps_a_unit) / steps_a_unit;
}

/// One number a measured thing, from the median of its times.
template <class FromMedian>
OrderedJson each_median(const FramePathSpeed& speed, const FromMedian& from_median) {
  OrderedJson json = {{"floor_cold", from_median(speed.floor.p50)},
                      {"plain_table", nullptr},
                      {"segment", from_median(speed.segment.p50)},
                      {"blobs", from_median(speed.blobs.p50)},
                      {"track", from_median(speed.track.p50)},
                      {"pixels_to_blobs", from_median(speed.pixels_to_blobs.p50)},
                      {"pixels_to_detections", from_median(speed.pixels_to_detections.p50)}};
  if (speed.plain_table) json["plain_table"] = from_median(speed.plain_table->p50);
  return json;
}

}  // namespace

std::string speed_json(const SpeedReport& report) {
  const FramePathSpeed& speed = report.frame_path;
  const LatencySpeed& latency = report.latency;
  const double pixels = report.frame_size_px.area();
  const auto of_table = [&](DurationFigures TableSpeed::*figures) {
    return report.table ? to_json((*report.table).*figures) : OrderedJson();
  };
  const OrderedJson json = {
      {"schema", "maggic-bench-1"},
      {"pipeline", report.pipeline},
      {"calibration", report.calibration ? OrderedJson(*report.calibration) : OrderedJson()},
      {"source", report.source},
      {"frame_size_px", {report.frame_size_px.width, report.frame_size_px.height}},
      {"frames", report.frames},
      {"frames_from_source", report.frames_from_source},
      {"scan", {{"threads", report.scan.threads}, {"search", name_of(report.scan.search)}}},
      {"threads", report.threads},
      {"simd_target", report.simd_target},
      {"machine",
       {{"cpu", report.machine.cpu},
        {"cores", report.machine.cores},
        {"last_level_cache_bytes", report.machine.last_level_cache_bytes}}},
      {"floor_cold_ms", to_json(speed.floor)},
      {"plain_table_ms", to_json(speed.plain_table)},
      {"stages",
       {{"segment_ms", to_json(speed.segment)},
        {"blobs_ms", to_json(speed.blobs)},
        {"track_ms", to_json(speed.track)}}},
      {"pixels_to_blobs_ms", to_json(speed.pixels_to_blobs)},
      {"pixels_to_detections_ms", to_json(speed.pixels_to_detections)},
      {"ns_per_pixel", each_median(speed,
                                   [&](std::chrono::nanoseconds time) {
                                     return rounded(static_cast<double>(time.count()) / pixels,
                                                    1e4);
                                   })},
      {"ratios_to_floor", each_median(speed,
                                      [&](std::chrono::nanoseconds time) {
                                        return rounded(in_ms(time) / in_ms(speed.floor.p50), 1e3);
                                      })},
      {"a_frame",
       {{"runs", speed.runs_a_frame},
        {"blobs", speed.blobs_a_frame},
        {"robots", speed.robots_a_frame}}},
      {"table_compile_ms", of_table(&TableSpeed::compile)},
      {"table_compile_threads_ms", of_table(&TableSpeed::compile_in_threads)},
      {"table_update_ms", of_table(&TableSpeed::update)},
      {"table_update", report.update},
      {"memcpy_16mib_ms", of_table(&TableSpeed::memcpy_16mib)},
      {"throughput",
       {{"one_thread_fps", report.throughput.one_thread_fps},
        {"threads_fps", report.throughput.threads_fps},
        {"pipelines_fps", report.throughput.pipelines_fps}}},
      {"latency",
       {{"capture_to_detection_ms", to_json(latency.capture_to_detection)},
        {"pace_fps", latency.frames_per_second},
        {"frames", latency.frames},
        {"dropped", latency.dropped}}}};
  return json_text(json);
}

}  // namespace maggic::app
