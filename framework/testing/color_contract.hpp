#pragma once
/// The contract of a stage that works on colours, checked for normalizers and segmenters alike.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "findings.hpp"

namespace maggic::testing {

using InputPlanes = std::span<const std::span<const std::uint8_t>>;
using OutputPlanes = std::span<const std::span<std::uint8_t>>;

/// A colour stage seen as a function from planes of bytes to planes of bytes.
struct ColorFunction {
  std::size_t inputs = 0;    ///< 3 for a normalizer, 6 for a segmenter.
  std::size_t outputs = 0;   ///< 3 for a normalizer, 1 for a segmenter.
  std::size_t values = 256;  ///< Every byte written is below this.
  std::function<void(InputPlanes, OutputPlanes)> run;
};

/// @param first, second two instances of one configuration.
void check_color_function(const ColorFunction& first, const ColorFunction& second,
                          Findings& findings);

}  // namespace maggic::testing
