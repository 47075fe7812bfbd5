#include "interchange/text_cursor.hpp"

#include <algorithm>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "config/characters.hpp"
#include "config/number_text.hpp"
#include "config/wording.hpp"

namespace maggic {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

}  // namespace

Place TextCursor::place() const { return {std::string(file_name_), line_, column_}; }

void TextCursor::skip(std::size_t bytes) {
  for (const char c : text_.substr(0, bytes)) {
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if (!is_continuation(c)) {
      ++column_;
    }
  }
  text_.remove_prefix(std::min(bytes, text_.size()));
}

void TextCursor::skip_blanks() { skip(std::min(text_.find_first_not_of(kBlanks), text_.size())); }

std::string_view TextCursor::take_until(std::string_view ends) {
  const std::string_view taken = text_.substr(0, text_.find_first_of(ends));
  skip(taken.size());
  return taken;
}

std::string_view TextCursor::take_word() {
  skip_blanks();
  return take_until(kBlanks);
}

int number_in_range(std::string_view text, const Place& place, int min, int max,
                    std::string_view what) {
  const auto number = parsed_integer(text);
  const int* value = std::get_if<int>(&number);
  if (value == nullptr || *value < min || *value > max) {
    throw ConfigError(
        {mistake_at(place, fmt::format("found {}, expected {}",
                                       text.empty() ? "nothing" : quoted_excerpt(text), what))});
  }
  return *value;
}

}  // namespace maggic
