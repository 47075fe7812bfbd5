#pragma once
/// Times as the program shows them.

#include <chrono>

namespace maggic::app {

inline double in_ms(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace maggic::app
