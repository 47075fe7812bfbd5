#include "maggic/simd_target.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

// As in row_kernels.cpp: what is not compiled there cannot be chosen.
#define HWY_COMPILE_ALL_ATTAINABLE
#include <hwy/highway.h>

namespace maggic {
namespace {

// Highway's bits: a smaller one stands for a wider set.
std::vector<std::int64_t> available() {
  const std::int64_t supported = (hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS;
  std::vector<std::int64_t> targets;
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) targets.push_back(rest & -rest);
  return targets;
}

std::int64_t& chosen() {
  static std::int64_t target = available().front();
  return target;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : available()) names.emplace_back(hwy::TargetName(target));
  return names;
}

std::string simd_target() { return hwy::TargetName(chosen()); }

void use_simd_target(std::string_view name) {
  const std::vector<std::int64_t> targets = available();
  const auto found =
      name.empty() ? targets.begin() : std::ranges::find(targets, name, [](std::int64_t target) {
        return std::string_view(hwy::TargetName(target));
      });
  if (found == targets.end()) {
    throw std::invalid_argument(fmt::format("no vector instruction set '{}' here (known: {})", name,
                                            fmt::join(simd_targets(), ", ")));
  }
  chosen() = *found;
  hwy::GetChosenTarget().Update(*found);
}

}  // namespace maggic
