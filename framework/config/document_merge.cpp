#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "config/characters.hpp"
#include "config/wording.hpp"
#include "maggic/document.hpp"

namespace maggic {
namespace {

/// `over` as it is where nothing lies below it: without the keys it would remove.
Node without_removals(const Node& over) {
  if (over.kind != Node::Kind::kMap) return over;
  Node kept;
  kept.kind = over.kind;
  kept.place = over.place;
  for (const Node::Entry& entry : over.entries) {
    if (entry.value.kind == Node::Kind::kNull) continue;
    kept.entries.push_back({entry.key, entry.key_place, without_removals(entry.value)});
  }
  return kept;
}

/// An index into a sequence; nothing when `text` is no such number.
std::optional<std::size_t> parsed_index(std::string_view text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return index;
}

[[noreturn]] void refuse_assignment(int column, std::string message) {
  throw ConfigError({{"--set", 1, column, std::move(message)}});
}

struct PathElement {
  std::string_view text;
  int column = 1;
};

std::vector<PathElement> split_path(std::string_view path) {
  std::vector<PathElement> elements;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string_view text = path.substr(begin, end - begin);
    const int column = static_cast<int>(characters_in(path.substr(0, begin))) + 1;
    if (text.empty()) {
      refuse_assignment(column, fmt::format("found an empty name in the path {}, expected "
                                            "path.to.key=value",
                                            quoted_excerpt(path)));
    }
    elements.push_back({text, column});
    if (end == path.size()) return elements;
    begin = end + 1;
  }
}

/// The item `element` names in a sequence.
std::size_t index_in(const Node& sequence, const PathElement& element) {
  const std::optional<std::size_t> index = parsed_index(element.text);
  if (!index || *index >= sequence.items.size()) {
    refuse_assignment(element.column,
                      fmt::format("found {}, expected the number of an item of a list of {} "
                                  "(from 0)",
                                  quoted_excerpt(element.text), sequence.items.size()));
  }
  return *index;
}

/// The node `element` names inside `parent`, made where it is missing.
Node& child_of(Node& parent, const PathElement& element) {
  const Place place{"--set", 1, element.column};
  if (parent.kind == Node::Kind::kSequence) return parent.items[index_in(parent, element)];
  if (parent.kind == Node::Kind::kScalar) {
    refuse_assignment(element.column,
                      fmt::format("found {} where the path goes on to {}, expected a map or a list",
                                  description_of(parent), quoted_excerpt(element.text)));
  }
  if (parent.kind == Node::Kind::kNull) {
    parent.kind = Node::Kind::kMap;
    parent.place = place;
  }
  if (Node* known = parent.find(element.text)) return *known;
  parent.entries.push_back({std::string(element.text), place, {}});
  parent.entries.back().value.place = place;
  return parent.entries.back().value;
}

void remove_child(Node& parent, const PathElement& element) {
  if (parent.kind == Node::Kind::kSequence) {
    const std::size_t index = index_in(parent, element);
    parent.items.erase(parent.items.begin() + static_cast<std::ptrdiff_t>(index));
    return;
  }
  child_of(parent, element);  // Refuses a path through a scalar.
  std::erase_if(parent.entries, [&](const Node::Entry& e) { return e.key == element.text; });
}

}  // namespace

void merge_document(Node& base, const Node& over) {
  if (over.kind == Node::Kind::kNull) return;
  if (base.kind != Node::Kind::kMap || over.kind != Node::Kind::kMap) {
    base = without_removals(over);
    return;
  }
  // An index keeps a merge of two huge maps from taking forever.
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < base.entries.size(); ++i) index.emplace(base.entries[i].key, i);
  std::vector<bool> removed(base.entries.size() + over.entries.size(), false);
  for (const Node::Entry& entry : over.entries) {
    const bool removes = entry.value.kind == Node::Kind::kNull;
    const auto known = index.find(entry.key);
    if (known == index.end()) {
      if (!removes) {
        base.entries.push_back({entry.key, entry.key_place, without_removals(entry.value)});
      }
    } else if (removes) {
      removed[known->second] = true;
    } else {
      merge_document(base.entries[known->second].value, entry.value);
    }
  }
  std::erase_if(base.entries,
                [&](const Node::Entry& e) { return removed[&e - base.entries.data()]; });
}

void set_in_document(Node& root, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    refuse_assignment(
        1, fmt::format("found {}, expected path.to.key=value", quoted_excerpt(assignment)));
  }
  const std::vector<PathElement> path = split_path(assignment.substr(0, equals));
  // Blanks in place of the path keep the columns of the value true.
  const std::string blanks(characters_in(assignment.substr(0, equals + 1)), ' ');
  Node value = parse_document(blanks + std::string(assignment.substr(equals + 1)), "--set");

  Node* parent = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) parent = &child_of(*parent, path[i]);
  if (value.kind == Node::Kind::kNull) {
    remove_child(*parent, path.back());
  } else {
    child_of(*parent, path.back()) = std::move(value);
  }
}

}  // namespace maggic
