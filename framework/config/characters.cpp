#include "config/characters.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace maggic {
namespace {

unsigned char byte_of(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

std::size_t characters_in(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, is_continuation));
}

std::size_t utf8_length(std::string_view text) {
  const unsigned char first = byte_of(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  // Overlong forms, surrogates and what lies beyond Unicode.
  const unsigned char second = byte_of(text, 1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

std::size_t invisible_length(std::string_view text) {
  const unsigned char first = byte_of(text, 0);
  if (first < 0x20 || first == 0x7F) return 1;
  // Terminals obey U+0080 … U+009F like the control characters of ASCII.
  if (first == 0xC2 && text.size() > 1 && byte_of(text, 1) < 0xA0) return 2;
  return text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
}

std::string escaped(std::string_view invisible) {
  if (invisible == "\n") return "\\n";
  if (invisible == "\t") return "\\t";
  if (invisible.starts_with(kByteOrderMark)) return "\\ufeff";
  return fmt::format("\\x{:02x}", byte_of(invisible, invisible.size() - 1));
}

}  // namespace maggic
