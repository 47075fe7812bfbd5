#include "config/wording.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "config/characters.hpp"

namespace maggic {
namespace {

/// Edits (insert, remove, replace, swap neighbours) that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t end = std::min(text.size(), kLongest);
  while (end < text.size() && end > 0 && is_continuation(text[end])) --end;
  std::string out = "'";
  for (std::size_t i = 0; i < end; ++i) {
    if (const std::size_t length = invisible_length(text.substr(i)); length != 0) {
      out += escaped(text.substr(i, length));
      i += length - 1;
    } else {
      out += text[i];
    }
  }
  if (end < text.size()) out += "…";
  return out + "'";
}

std::string description_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull: return "nothing";
    case Node::Kind::kScalar: return quoted_excerpt(node.scalar);
    case Node::Kind::kSequence: return "a list";
    case Node::Kind::kMap: return "a map";
  }
  return "nothing";
}

std::string_view nearest_name(std::string_view name, std::span<const std::string> known) {
  std::string_view nearest;
  // One slip in three letters is a slip; more is another word. Long names are not worth the time.
  constexpr std::size_t kLongest = 64;
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;
  if (name.size() > kLongest) return nearest;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string unknown_name_message(std::string_view what, std::string_view name,
                                 std::span<const std::string> known) {
  std::string message = fmt::format("unknown {} {}", what, quoted_excerpt(name));
  if (const std::string_view nearest = nearest_name(name, known); !nearest.empty()) {
    message += fmt::format(", did you mean '{}'?", nearest);
  }
  if (known.empty()) return message + ", expected none";
  return message + fmt::format(" (known: {})", fmt::join(known, ", "));
}

Mistake mistake_at(const Place& place, std::string message) {
  return {place.file, place.line, place.column, std::move(message)};
}

}  // namespace maggic
