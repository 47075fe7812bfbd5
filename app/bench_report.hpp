#pragma once
/// What `maggic bench` measured, as a person reads it and as JSON.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <opencv2/core/types.hpp>

#include "maggic/machine_description.hpp"
#include "maggic/speed_measurement.hpp"

namespace maggic::app {

struct SpeedReport {
  std::string pipeline;
  std::optional<std::string> calibration;
  std::string source;
  cv::Size frame_size_px;
  std::uint64_t frames = 0;            ///< Measured.
  std::size_t frames_from_source = 0;  ///< Distinct ones; the others are copies of these.
  unsigned threads = 1;                ///< Of what is measured with several.
  std::string simd_target;
  MachineDescription machine;
  FramePathSpeed frame_path;
  std::optional<TableSpeed> table;
  std::string update;  ///< What was changed before the table was compiled again.
  double frames_per_second_alone = 0.0;
  double frames_per_second_in_threads = 0.0;
  LatencySpeed latency;
};

/// Tables, and the sentences needed to read them.
std::string speed_text(const SpeedReport& report);

/// Ends with a newline. The keys are documented in docs/performance.md and stay as they are.
std::string speed_json(const SpeedReport& report);

}  // namespace maggic::app
