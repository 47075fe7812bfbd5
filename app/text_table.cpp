#include "app/text_table.hpp"

#include <algorithm>

namespace maggic::app {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kMinWrapWidth = 24;  // below this wrapping is worse than a long line

/// A further byte of a UTF-8 character.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(std::min(blank + 1, text.size()));
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (columns_of(line) + 1 + columns_of(word) <= width) {
      line.append(" ").append(word);
    } else {
      lines.emplace_back(word);
    }
  }
  return lines;
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_character));
}

std::string shortened(std::string_view text, std::size_t columns) {
  if (columns_of(text) <= columns) return std::string(text);
  std::size_t end = 0;
  std::size_t after_item = 0;
  for (std::size_t used = 1; used < columns; ++used) {  // one column is the ellipsis's
    ++end;
    while (end < text.size() && continues_character(text[end])) ++end;
    if (text.substr(0, end).ends_with(", ")) after_item = end;
  }
  return std::string(text.substr(0, after_item != 0 ? after_item : end)) + "…";
}

void TextTable::add(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

std::string TextTable::to_string(std::size_t indent, std::size_t max_width) const {
  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  }
  std::size_t last_starts = indent;
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) last_starts += widths[i] + kGap;
  const std::size_t room = max_width > last_starts ? max_width - last_starts : 0;
  const std::size_t last_width = std::max(room, kMinWrapWidth);

  std::string out;
  for (const auto& row : rows_) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      const std::string padding(widths[i] - columns_of(row[i]), ' ');
      line += columns_[i] == Align::kRight ? padding + row[i] : row[i] + padding;
      line.append(kGap, ' ');
    }
    std::vector<std::string> last{row.back()};
    if (columns_.back() == Align::kRight) {
      last[0].insert(0, widths.back() - columns_of(last[0]), ' ');
    } else {
      last = wrapped(row.back(), last_width);
    }
    for (const std::string& piece : last) {
      line += piece;
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + '\n';
      line.assign(last_starts, ' ');
    }
  }
  return out;
}

}  // namespace maggic::app
