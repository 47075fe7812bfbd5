#pragma once
/// UTF-8, as far as configuration files need it.

#include <cstddef>
#include <string>
#include <string_view>

namespace maggic {

/// Whether `c` is not the first byte of its character.
constexpr bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::size_t characters_in(std::string_view text);

/// Length in bytes of the well-formed character that non-empty `text` starts with; 0 when there is
/// none.
std::size_t utf8_length(std::string_view text);

/// Length in bytes of the control character or byte order mark that non-empty `text` starts with;
/// 0 when it starts with anything else.
std::size_t invisible_length(std::string_view text);

/// A character of `invisible_length` as YAML's double quotes and people read it: "\n", "\x1b".
std::string escaped(std::string_view invisible);

}  // namespace maggic
