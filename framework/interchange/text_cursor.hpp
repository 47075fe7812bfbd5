#pragma once
/// Reads text from front to back and knows where it is.

#include <cstddef>
#include <string_view>

#include "maggic/document.hpp"

namespace maggic {

class TextCursor {
 public:
  TextCursor(std::string_view text, std::string_view file_name)
      : text_(text), file_name_(file_name) {}

  bool at_end() const { return text_.empty(); }
  std::string_view rest() const { return text_; }
  /// Line and column, both from 1, of what `rest` starts with.
  Place place() const;

  void skip(std::size_t bytes);
  void skip_blanks();
  /// The longest front part of `rest` without any of `ends`, which is passed.
  std::string_view take_until(std::string_view ends);
  /// A word up to the next blank; empty at the end.
  std::string_view take_word();

 private:
  std::string_view text_;
  std::string_view file_name_;
  int line_ = 1;
  int column_ = 1;
};

/// A whole number. @throws ConfigError unless it is one within [min, max].
/// @param what for the message: "a hue from -1 to 255".
int number_in_range(std::string_view text, const Place& place, int min, int max,
                    std::string_view what);

}  // namespace maggic
