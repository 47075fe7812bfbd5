#pragma once
/// Numbers as configuration files write them, and ranges as messages write them.

#include <string>
#include <string_view>
#include <variant>

#include "maggic/parameters.hpp"

namespace maggic {

/// Why a text is no number of the wanted kind.
enum class NumberFault {
  kNotANumber,
  kLeadingZero,  ///< `010`: eight to some readers, ten to others.
  kTooLarge,     ///< A number, but none this kind can hold.
};

/// Decimal with an optional sign, or 0x with hexadecimal digits; nothing else around it.
std::variant<int, NumberFault> parsed_integer(std::string_view text);

/// The same, and decimal fractions with an optional exponent. Always finite.
std::variant<double, NumberFault> parsed_number(std::string_view text);

/// "from 0 to 255", "of at least 0", "of at most 1", or empty where every number is allowed.
std::string range_in_words(Range<int> range);
std::string range_in_words(Range<double> range);

/// "0 … 255", "≥ 0", "≤ 1", or empty.
std::string range_in_signs(Range<int> range);
std::string range_in_signs(Range<double> range);

}  // namespace maggic
