#include "maggic/machine_description.hpp"

#include <algorithm>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

namespace maggic {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

/// The kernel's "32768K"; 0 where there is no such cache.
std::size_t size_of_cache(int index) {
  std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", index));
  std::size_t size = 0;
  char unit = 0;
  if (!(file >> size)) return 0;
  file >> unit;
  if (unit == 'K') return size << 10;
  if (unit == 'M') return size << 20;
  return size;
}

// sysconf is asked second: for a processor of several dies glibc adds their caches up, though a
// core fills its own die's alone.
std::size_t largest_cache_bytes() {
  constexpr int kMostCaches = 8;
  std::size_t largest = 0;
  for (int index = 0; index < kMostCaches; ++index) {
    largest = std::max(largest, size_of_cache(index));
  }
  if (largest > 0) return largest;
  return static_cast<std::size_t>(std::max(0L, ::sysconf(_SC_LEVEL3_CACHE_SIZE)));
}

}  // namespace

MachineDescription describe_machine() {
  return {cpu_name(), std::max(1U, std::thread::hardware_concurrency()), largest_cache_bytes()};
}

}  // namespace maggic
