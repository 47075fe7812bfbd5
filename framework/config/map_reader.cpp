#include "config/map_reader.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "config/number_text.hpp"
#include "config/wording.hpp"

namespace maggic {
namespace {

template <class T>
std::string expected_number(Range<T> range) {
  const std::string noun = std::is_same_v<T, int> ? "an integer" : "a number";
  const std::string words = range_in_words(range);
  return words.empty() ? noun : noun + ' ' + words;
}

/// What is wrong with a number, as "… , expected …"; empty when `parsed` is within `range`.
template <class T>
std::string number_mistake(const Node& node, const std::variant<T, NumberFault>& parsed,
                           Range<T> range) {
  const std::string expected = expected_number(range);
  const std::string found = quoted_excerpt(node.scalar);
  constexpr std::size_t kLongestNumber = 40;
  const std::string& shown = node.scalar.size() <= kLongestNumber ? node.scalar : found;
  const NumberFault* fault = std::get_if<NumberFault>(&parsed);
  if (fault != nullptr && *fault == NumberFault::kNotANumber) {
    return fmt::format("found {}, expected {}", found, expected);
  }
  if (fault != nullptr && *fault == NumberFault::kLeadingZero) {
    return fmt::format("found {}, expected {} without leading zeros", found, expected);
  }
  if (const T* value = std::get_if<T>(&parsed)) {
    if (*value >= range.min && *value <= range.max) return "";
  }
  return fmt::format("{} is out of range, expected {}", shown, expected);
}

std::string count_in_words(Range<int> count) {
  if (count.min == count.max) return std::to_string(count.min);
  if (count.max == std::numeric_limits<int>::max()) return fmt::format("at least {}", count.min);
  return fmt::format("{} to {}", count.min, count.max);
}

std::vector<std::string> color_names(const Palette& palette) {
  std::vector<std::string> names;
  for (std::size_t label = 1; label < palette.size(); ++label) {
    names.emplace_back(palette.name(static_cast<Label>(label)));
  }
  return names;
}

/// The label of a colour; nothing for background and unknown names.
std::optional<Label> color_label(const Palette& palette, std::string_view name) {
  const std::optional<Label> label = palette.find(name);
  return label && *label != kBackground ? label : std::nullopt;
}

}  // namespace

MapReader::MapReader(const Node* node, std::string path, Place place, const Palette& palette,
                     std::vector<Mistake>& mistakes, Completeness completeness)
    : node_(node),
      path_(std::move(path)),
      place_(std::move(place)),
      palette_(palette),
      mistakes_(mistakes),
      mistakes_before_(mistakes.size()),
      completeness_(completeness) {}

void MapReader::finish() {
  if (node_ == nullptr || node_->kind == Node::Kind::kNull || asked_for_itself_) return;
  const auto was_asked = [&](const Node::Entry& e) {
    return std::ranges::find(asked_, e.key) != asked_.end();
  };
  if (node_->kind == Node::Kind::kMap) {
    for (const Node::Entry& entry : node_->entries) {
      if (was_asked(entry)) continue;
      note(entry.key_place, path_, unknown_name_message("key", entry.key, asked_));
    }
  } else if (!asked_.empty()) {
    note_expected(*node_, path_,
                  fmt::format("a map of parameters (known: {})", fmt::join(asked_, ", ")));
  }
}

void MapReader::boolean(const Parameter& what, bool& value) {
  const Node* node = scalar(what, "true or false", false);
  if (node == nullptr) return;
  if (node->scalar == "true" || node->scalar == "false") {
    value = node->scalar == "true";
  } else {
    note_expected(*node, path_of(what.key), "true or false");
  }
}

void MapReader::integer(const Parameter& what, int& value, Range<int> range) {
  const Node* node = scalar(what, expected_number(range), false);
  if (node == nullptr) return;
  const std::variant<int, NumberFault> parsed = parsed_integer(node->scalar);
  if (const std::string mistake = number_mistake(*node, parsed, range); !mistake.empty()) {
    note(node->place, path_of(what.key), mistake);
  } else {
    value = std::get<int>(parsed);
  }
}

void MapReader::number(const Parameter& what, double& value, Range<double> range) {
  const Node* node = scalar(what, expected_number(range), false);
  if (node != nullptr) read_number(*node, path_of(what.key), value, range);
}

void MapReader::text(const Parameter& what, std::string& value) {
  if (const Node* node = scalar(what, "text", true)) value = node->scalar;
}

void MapReader::color(const Parameter& what, Label& value) {
  const Node* node = scalar(what, "a colour's name", true);
  if (node == nullptr) return;
  if (const std::optional<Label> label = color_label(palette_, node->scalar)) {
    value = *label;
  } else {
    note(node->place, path_of(what.key),
         unknown_name_message("colour", node->scalar, color_names(palette_)));
  }
}

void MapReader::numbers(const Parameter& what, std::span<double> values, Range<double> range) {
  const std::string expected = fmt::format("a list of {} numbers", values.size());
  const Node* node = look_up(what, expected);
  if (node == nullptr) return;
  const std::string path = path_of(what.key);
  if (node->kind != Node::Kind::kSequence) {
    note_expected(*node, path, expected);
    return;
  }
  if (node->items.size() != values.size()) {
    note(node->place, path,
         fmt::format("found a list of {}, expected {}", node->items.size(), expected));
    return;
  }
  std::vector<double> read(values.begin(), values.end());
  bool all_read = true;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Node& item = node->items[i];
    const std::string item_path = fmt::format("{}[{}]", path, i);
    if (item.kind != Node::Kind::kScalar || item.quoted) {
      note_expected(item, item_path, expected_number(range));
      all_read = false;
    } else {
      all_read = read_number(item, item_path, read[i], range) && all_read;
    }
  }
  if (all_read) std::ranges::copy(read, values.begin());
}

void MapReader::group(const Parameter& what, const std::function<void(Parameters&)>& members) {
  const Node* node = look_up(what, "a map");
  MapReader reader(node, path_of(what.key), node != nullptr ? node->place : place_, palette_,
                   mistakes_, completeness_);
  members(reader);
  reader.finish();
}

void MapReader::check(std::string_view key, bool holds, std::string_view message) {
  // A rule between values of which one was not read would only add noise.
  if (holds || mistakes_.size() > mistakes_before_) return;
  const Node* node = key.empty() || node_ == nullptr ? node_ : node_->find(key);
  if (completeness_ == Completeness::kPart && (key.empty() || node == nullptr)) return;
  note(node != nullptr ? node->place : place_, path_of(key), message);
}

void MapReader::choice_index(const Parameter& what, std::size_t& index,
                             std::span<const std::string_view> names) {
  const std::vector<std::string> known(names.begin(), names.end());
  const Node* node = scalar(what, fmt::format("one of {}", fmt::join(known, ", ")), true);
  if (node == nullptr) return;
  const auto found = std::ranges::find(known, node->scalar);
  if (found != known.end()) {
    index = static_cast<std::size_t>(found - known.begin());
  } else {
    note(node->place, path_of(what.key), unknown_name_message("name", node->scalar, known));
  }
}

void MapReader::list_elements(const Parameter& what, Elements& elements, Range<int> count) {
  const Node* node = look_up(what, "a list");
  if (node == nullptr) return;
  const std::string path = path_of(what.key);
  std::vector<const Node*> nodes;
  std::vector<std::string> paths;
  if (node->kind == Node::Kind::kScalar) {
    nodes.push_back(node);
    paths.push_back(path);
  } else if (node->kind == Node::Kind::kSequence) {
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      nodes.push_back(&node->items[i]);
      paths.push_back(fmt::format("{}[{}]", path, i));
    }
  } else {
    note_expected(*node, path, "a list");
    return;
  }
  const bool fits = has_count(*node, path, nodes.size(), count);
  if (fits) elements.reset(nodes.size());
  read_elements(nodes, paths, elements, fits);
}

void MapReader::color_elements(const Parameter& what, ColorElements& elements, Range<int> count) {
  const Node* node = look_up(what, "a map from colours");
  if (node == nullptr) return;
  const std::string path = path_of(what.key);
  if (node->kind != Node::Kind::kMap) {
    note_expected(*node, path, "a map from colours");
    return;
  }
  const bool fits = has_count(*node, path, node->entries.size(), count);
  if (fits) elements.reset(node->entries.size());
  std::vector<const Node*> nodes;
  std::vector<std::string> paths;
  for (const Node::Entry& entry : node->entries) {
    if (const std::optional<Label> label = color_label(palette_, entry.key)) {
      if (fits) elements.set_label(nodes.size(), *label);
    } else {
      note(entry.key_place, path, unknown_name_message("colour", entry.key, color_names(palette_)));
    }
    nodes.push_back(&entry.value);
    paths.push_back(path.empty() ? entry.key : fmt::format("{}.{}", path, entry.key));
  }
  read_elements(nodes, paths, elements, fits);
}

Parameters::OptionalOutcome MapReader::optional_value(const Parameter& what, bool /*has_default*/,
                                                      const std::function<void()>& describe_value) {
  const Node* node = look_up(what.key);
  if (node != nullptr &&
      (node->kind == Node::Kind::kNull ||
       (node->kind == Node::Kind::kScalar && !node->quoted && node->scalar == "none"))) {
    return OptionalOutcome::kEmptied;
  }
  const std::size_t before = mistakes_.size();
  describe_value();
  return node == nullptr || mistakes_.size() > before ? OptionalOutcome::kUnchanged
                                                      : OptionalOutcome::kRead;
}

const Node* MapReader::look_up(std::string_view key) {
  if (key.empty()) {
    asked_for_itself_ = true;
    return node_;
  }
  if (std::ranges::find(asked_, key) == asked_.end()) asked_.emplace_back(key);
  return node_ == nullptr ? nullptr : std::as_const(*node_).find(key);
}

const Node* MapReader::look_up(const Parameter& what, std::string_view expected) {
  const Node* node = look_up(what.key);
  // A group left out is reported as a whole or not at all, and so is one that is no map.
  const bool is_whole_map = completeness_ == Completeness::kWhole && node_ != nullptr &&
                            (node_->kind == Node::Kind::kMap || node_->kind == Node::Kind::kNull);
  if (node == nullptr && is_whole_map && what.presence == Presence::kRequired) {
    note(place_, path_of(what.key),
         fmt::format("missing, expected {} ({})", expected, what.meaning));
  }
  return node;
}

const Node* MapReader::scalar(const Parameter& what, const std::string& expected,
                              bool may_be_quoted) {
  const Node* node = look_up(what, expected);
  if (node == nullptr) return nullptr;
  const std::string path = path_of(what.key);
  if (node->kind != Node::Kind::kScalar) {
    note_expected(*node, path, expected);
    return nullptr;
  }
  if (node->quoted && !may_be_quoted) {
    note_expected(*node, path, expected);
    return nullptr;
  }
  return node;
}

bool MapReader::read_number(const Node& node, const std::string& path, double& value,
                            Range<double> range) {
  const std::variant<double, NumberFault> parsed = parsed_number(node.scalar);
  const std::string mistake = number_mistake(node, parsed, range);
  if (mistake.empty()) {
    value = std::get<double>(parsed);
  } else {
    note(node.place, path, mistake);
  }
  return mistake.empty();
}

void MapReader::read_elements(const std::vector<const Node*>& nodes,
                              const std::vector<std::string>& paths, Elements& elements,
                              bool fits) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    // An element is whole even where the map around it is a part: lists replace lists.
    MapReader reader(nodes[i], paths[i], nodes[i]->place, palette_, mistakes_,
                     Completeness::kWhole);
    // A list of a wrong length keeps its default, which `check` may count on; what is written is
    // read all the same, for its mistakes.
    if (fits) {
      elements.describe(i, reader);
    } else {
      elements.describe_fresh(reader);
    }
    reader.finish();
  }
}

bool MapReader::has_count(const Node& node, const std::string& path, std::size_t found,
                          Range<int> count) {
  const bool is_enough = found >= static_cast<std::size_t>(std::max(count.min, 0));
  if (is_enough && found <= static_cast<std::size_t>(std::max(count.max, 0))) return true;
  note(node.place, path,
       fmt::format("found {} {}, expected {}", found, found == 1 ? "entry" : "entries",
                   count_in_words(count)));
  return false;
}

std::string MapReader::path_of(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void MapReader::note(const Place& place, const std::string& path, std::string_view message) {
  mistakes_.push_back(mistake_at(
      place, path.empty() ? std::string(message) : fmt::format("{}: {}", path, message)));
}

void MapReader::note_expected(const Node& found, const std::string& path,
                              std::string_view expected) {
  if (found.kind == Node::Kind::kScalar && found.quoted && expected != "text") {
    note(found.place, path,
         fmt::format("found {} in quotes, expected {}", description_of(found), expected));
  } else {
    note(found.place, path, fmt::format("found {}, expected {}", description_of(found), expected));
  }
}

}  // namespace maggic
