#pragma once
/// Feeds a `describe` function from a document, or prints what it declares.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/parameters.hpp"
#include "maggic/stage.hpp"

namespace maggic {

using Describe = std::function<void(Parameters&)>;

/// Whether a map is all there is, or part of one that lies elsewhere (an unused calibration block).
enum class Completeness { kWhole, kPart };

/// Reads the map `node` (null counts as an empty map) through `describe`. Mistakes are appended:
/// wrong types, values out of range, missing required keys, and keys `describe` never asked for,
/// each with the known keys or the nearest one. Numbers are decimal (or 0x…) only: `010` and
/// `.nan` are mistakes, and so is a quoted number. A part may lack required keys, and rules are
/// judged only where they concern a key it holds.
void read_parameters(const Node& node, const Palette& palette, const Describe& describe,
                     std::vector<Mistake>& mistakes,
                     Completeness completeness = Completeness::kWhole);

/// Configures and prepares a stage from YAML text, as tests and tools like it.
/// @throws ConfigError with every mistake.
void configure_stage(Stage& stage, std::string_view yaml, const Palette& palette,
                     Reporter& reporter);

/// One line of `maggic describe`.
struct ParameterRow {
  std::string path;           ///< "gray_threshold", "boxes.<color>.y", "layouts[].name".
  std::string type;           ///< "integer", "number", "text", "one of a|b", "[number ×2]", …
  std::string default_value;  ///< As it would be written in YAML; "required" when there is none.
  std::string range;          ///< "0 … 255", or empty.
  std::string unit;
  std::string meaning;
};

std::vector<ParameterRow> parameter_table(const Palette& palette, const Describe& describe);

/// What `describe` holds now, as a map that read_parameters would make the same of; null when it
/// declares nothing. Texts that look like numbers are not quoted until to_yaml writes them.
Node parameter_values(const Palette& palette, const Describe& describe);

}  // namespace maggic
