#pragma once
/// When a live picture was taken, in Unix time that never jumps.

#include <chrono>
#include <cmath>

#include "maggic/frame.hpp"

namespace maggic::live {

/// How long ago the driver says a picture was taken. V4L2 stamps a buffer with CLOCK_MONOTONIC,
/// which is what std::chrono::steady_clock reads on Linux; other drivers give a position in a
/// stream, wall time, or 0.
/// @param driver_ms the driver's stamp in milliseconds.
/// @return zero when the stamp cannot be a moment of that clock within the last second.
inline std::chrono::nanoseconds age_by_driver(double driver_ms,
                                              std::chrono::nanoseconds monotonic_now) {
  constexpr std::chrono::nanoseconds kOldest = std::chrono::seconds(1);
  const double age_ns = static_cast<double>(monotonic_now.count()) - driver_ms * 1e6;
  if (!(age_ns > 0.0 && age_ns < static_cast<double>(kOldest.count()))) {
    return std::chrono::nanoseconds(0);
  }
  return std::chrono::nanoseconds(std::llround(age_ns));
}

/// The monotonic clock plus the distance to the Unix epoch as it was at the start: setting the
/// machine's clock during a match must not look like motion.
class CaptureClock {
 public:
  /// Now.
  Timestamp now() const { return monotonic_now() + to_unix_; }
  /// When a picture just received was taken, by the driver's stamp where that is of use.
  Timestamp captured(double driver_ms) const {
    const std::chrono::nanoseconds now = monotonic_now();
    return now - age_by_driver(driver_ms, now) + to_unix_;
  }

 private:
  static std::chrono::nanoseconds monotonic_now() {
    return std::chrono::steady_clock::now().time_since_epoch();
  }
  static std::chrono::nanoseconds unix_now() {
    return std::chrono::system_clock::now().time_since_epoch();
  }

  const std::chrono::nanoseconds to_unix_ = unix_now() - monotonic_now();
};

}  // namespace maggic::live
