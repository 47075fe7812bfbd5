#pragma once
/// Text in aligned columns.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace maggic::app {

/// How many columns UTF-8 text takes, counting one a code point.
std::size_t columns_of(std::string_view text);

/// `text` in at most `columns` columns (≥ 1), its end replaced by '…' where it is longer; a list is
/// cut between its items where one fits.
std::string shortened(std::string_view text, std::size_t columns);

/// Rows of cells; every column as wide as its widest cell, the last one wrapped at word borders
/// where the table would be wider than asked for.
class TextTable {
 public:
  enum class Align { kLeft, kRight };

  explicit TextTable(std::vector<Align> columns) : columns_(std::move(columns)) {}

  /// @param cells as many as there are columns.
  void add(std::vector<std::string> cells);

  /// @param indent blanks before every line. @return lines ended by '\n', without blanks at ends.
  std::string to_string(std::size_t indent, std::size_t max_width) const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace maggic::app
