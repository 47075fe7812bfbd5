#pragma once
/// What `maggic bench` measured, as a person reads it and as JSON.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <opencv2/core/types.hpp>

#include "maggic/machine_description.hpp"
#include "maggic/scan_parameters.hpp"
#include "maggic/speed_measurement.hpp"

namespace maggic::app {

/// Frames a second.
struct Throughput {
  double one_thread_fps = 0.0;  ///< One pipeline, one thread.
  double threads_fps = 0.0;     ///< One pipeline, the rows of a frame shared by the threads.
  double pipelines_fps = 0.0;   ///< As many pipelines as threads, each on one, in all.
};

struct SpeedReport {
  std::string pipeline;
  std::optional<std::string> calibration;
  std::string source;
  cv::Size frame_size_px;
  std::uint64_t frames = 0;            ///< Measured.
  std::size_t frames_from_source = 0;  ///< Distinct ones; the others are copies of these.
  ScanParameters scan;                 ///< Of the pipeline.
  unsigned threads = 1;                ///< Of what is measured with several.
  std::string simd_target;
  MachineDescription machine;
  FramePathSpeed frame_path;
  std::optional<TableSpeed> table;
  std::string update;  ///< What was changed before the table was compiled again.
  Throughput throughput;
  LatencySpeed latency;
};

/// Tables, and the sentences needed to read them.
std::string speed_text(const SpeedReport& report);

/// "full" or "predicted".
std::string_view name_of(ScanParameters::Search search);

/// Ends with a newline. The keys are documented in docs/performance.md and stay as they are.
std::string speed_json(const SpeedReport& report);

}  // namespace maggic::app
