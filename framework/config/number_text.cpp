#include "config/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <system_error>

#include <fmt/format.h>

namespace maggic {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// How many digits `text` starts with.
std::size_t digits_in_front(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
}

/// Splits a sign off. `-` stays in front for std::from_chars, which does not know `+`.
std::string_view without_sign(std::string_view& text) {
  std::string_view digits = text;
  if (text.starts_with('+')) text.remove_prefix(1);
  if (digits.starts_with('+') || digits.starts_with('-')) digits.remove_prefix(1);
  return digits;
}

std::variant<unsigned long long, NumberFault> parsed_hexadecimal(std::string_view digits) {
  unsigned long long value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
  if (stop != end || error == std::errc::invalid_argument) return NumberFault::kNotANumber;
  if (error == std::errc::result_out_of_range) return NumberFault::kTooLarge;
  return value;
}

bool is_hexadecimal(std::string_view text) { return text.starts_with("0x") && text.size() > 2; }

bool has_leading_zero(std::string_view digits) {
  return digits.size() > 1 && digits[0] == '0' && is_digit(digits[1]);
}

/// Whether unsigned `text` is digits with an optional fraction and exponent.
bool is_decimal(std::string_view text) {
  std::size_t digits = digits_in_front(text);
  text.remove_prefix(digits);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::size_t fraction = digits_in_front(text);
    text.remove_prefix(fraction);
    digits += fraction;
  }
  if (digits == 0) return false;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  const std::string_view exponent = without_sign(text);
  return !exponent.empty() && digits_in_front(exponent) == exponent.size();
}

template <class T>
bool is_open_below(Range<T> range) {
  return range.min <= std::numeric_limits<T>::lowest();
}

template <class T>
bool is_open_above(Range<T> range) {
  return range.max >= std::numeric_limits<T>::max();
}

template <class T>
std::string words(Range<T> range) {
  if (is_open_below(range) && is_open_above(range)) return "";
  if (is_open_below(range)) return fmt::format("of at most {}", range.max);
  if (is_open_above(range)) return fmt::format("of at least {}", range.min);
  return fmt::format("from {} to {}", range.min, range.max);
}

template <class T>
std::string signs(Range<T> range) {
  if (is_open_below(range) && is_open_above(range)) return "";
  if (is_open_below(range)) return fmt::format("≤ {}", range.max);
  if (is_open_above(range)) return fmt::format("≥ {}", range.min);
  return fmt::format("{} … {}", range.min, range.max);
}

}  // namespace

std::variant<int, NumberFault> parsed_integer(std::string_view text) {
  if (is_hexadecimal(text)) {
    const auto value = parsed_hexadecimal(text.substr(2));
    if (const NumberFault* fault = std::get_if<NumberFault>(&value)) return *fault;
    const unsigned long long number = std::get<unsigned long long>(value);
    if (number > static_cast<unsigned long long>(std::numeric_limits<int>::max())) {
      return NumberFault::kTooLarge;
    }
    return static_cast<int>(number);
  }
  const std::string_view digits = without_sign(text);
  if (digits.empty() || digits_in_front(digits) != digits.size()) return NumberFault::kNotANumber;
  if (has_leading_zero(digits)) return NumberFault::kLeadingZero;
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return NumberFault::kTooLarge;
  return value;
}

std::variant<double, NumberFault> parsed_number(std::string_view text) {
  if (is_hexadecimal(text)) {
    const auto value = parsed_hexadecimal(text.substr(2));
    if (const NumberFault* fault = std::get_if<NumberFault>(&value)) return *fault;
    return static_cast<double>(std::get<unsigned long long>(value));
  }
  const std::string_view digits = without_sign(text);
  if (!is_decimal(digits)) return NumberFault::kNotANumber;
  if (has_leading_zero(digits)) return NumberFault::kLeadingZero;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return NumberFault::kTooLarge;
  return value;
}

std::string range_in_words(Range<int> range) { return words(range); }
std::string range_in_words(Range<double> range) { return words(range); }
std::string range_in_signs(Range<int> range) { return signs(range); }
std::string range_in_signs(Range<double> range) { return signs(range); }

}  // namespace maggic
