/// libFuzzer target: whatever the bytes, reading them ends, in a calibration or a ConfigError, and
/// what is made of a calibration is a YAML file that can be read.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "maggic/foreign_calibration.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  maggic::ImportedCalibration imported;
  try {
    const maggic::ForeignCalibration calibration =
        maggic::parse_foreign_calibration(text, "fu\nzz: #x");
    imported = maggic::import_calibrations({&calibration, 1}, cv::Size(640, 480));
  } catch (const maggic::ConfigError& e) {
    if (e.mistakes().empty()) std::abort();
    return 0;
  }
  if (imported.found.empty()) std::abort();
  maggic::parse_document(imported.yaml, "imported.yaml");
  return 0;
}
