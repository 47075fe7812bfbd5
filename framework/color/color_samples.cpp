#include "maggic/color_samples.hpp"

#include <fmt/format.h>

namespace maggic {

std::string describe(const GrayThreshold& threshold) {
  if (threshold.given) return "given by hand";
  if (threshold.lowest == threshold.highest) return "the only one of those tried that finds all";
  return fmt::format("{} … {} finds the same robots", threshold.lowest, threshold.highest);
}

}  // namespace maggic
