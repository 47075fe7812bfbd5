#include "declaration_check.hpp"

#include <algorithm>
#include <utility>

namespace maggic::testing {
namespace {

bool is_well_formed(std::string_view key) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_allowed = [&](char c) { return is_lower(c) || (c >= '0' && c <= '9') || c == '_'; };
  return is_lower(key.front()) && std::ranges::all_of(key, is_allowed);
}

Node scalar(std::string text, bool quoted = false) {
  Node node;
  node.kind = Node::Kind::kScalar;
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

}  // namespace

DeclarationCheck::DeclarationCheck(const Palette& palette, Values values, Findings& findings)
    : palette_(palette), values_(values), findings_(findings) {
  root_.kind = Node::Kind::kMap;
}

Node* DeclarationCheck::declare(const Parameter& what) {
  if (what.key.empty()) return current_;  // the element of a list itself
  if (!is_well_formed(what.key)) {
    findings_.add("key '{}' is declared, expected lower-case letters, digits and _", what.key);
  }
  if (what.meaning.empty()) findings_.add("parameter '{}' has no meaning", what.key);
  if (std::ranges::find(keys_, what.key) != keys_.end()) {
    findings_.add("key '{}' is declared twice", what.key);
  }
  keys_.emplace_back(what.key);
  if (values_ == Values::kIgnoreRequired && what.presence == Presence::kRequired) return nullptr;
  current_->kind = Node::Kind::kMap;
  current_->entries.push_back({std::string(what.key), {}, {}});
  return &current_->entries.back().value;
}

void DeclarationCheck::describe_into(Node& node, const std::function<void()>& describe) {
  // `node` stays where it is meanwhile: only what hangs below it grows.
  Node* const outer = std::exchange(current_, &node);
  std::vector<std::string> outer_keys = std::exchange(keys_, {});
  describe();
  current_ = outer;
  keys_ = std::move(outer_keys);
}

template <class T>
void DeclarationCheck::check_range(const Parameter& what, std::span<const T> values,
                                   Range<T> range) {
  if (!(range.min <= range.max)) {
    findings_.add("parameter '{}' has the empty range {} … {}", what.key, range.min, range.max);
    return;
  }
  for (const T value : values) {
    if (!(value >= range.min && value <= range.max)) {
      findings_.add("parameter '{}' is {} by default, expected a value within its range {} … {}",
                    what.key, value, range.min, range.max);
    }
  }
}

void DeclarationCheck::check_count(const Parameter& what, std::size_t size, Range<int> count) {
  const int elements = static_cast<int>(size);
  if (count.min > count.max || elements < count.min || elements > count.max) {
    findings_.add("parameter '{}' has {} elements by default, expected {} to {}", what.key,
                  elements, count.min, count.max);
  }
}

void DeclarationCheck::boolean(const Parameter& what, bool& value) {
  if (Node* node = declare(what)) *node = scalar(value ? "true" : "false");
}

void DeclarationCheck::integer(const Parameter& what, int& value, Range<int> range) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  check_range<int>(what, {&value, 1}, range);
  *node = scalar(fmt::format("{}", value));
}

void DeclarationCheck::number(const Parameter& what, double& value, Range<double> range) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  check_range<double>(what, {&value, 1}, range);
  *node = scalar(fmt::format("{}", value));
}

void DeclarationCheck::text(const Parameter& what, std::string& value) {
  if (Node* node = declare(what)) *node = scalar(value, true);
}

void DeclarationCheck::color(const Parameter& what, Label& value) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  if (value == kBackground || value >= palette_.size()) {
    findings_.add("parameter '{}' is label {} by default, expected a colour of the palette",
                  what.key, value);
    return;
  }
  *node = scalar(std::string(palette_.name(value)));
}

void DeclarationCheck::numbers(const Parameter& what, std::span<double> values,
                               Range<double> range) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  check_range<double>(what, values, range);
  node->kind = Node::Kind::kSequence;
  for (const double value : values) node->items.push_back(scalar(fmt::format("{}", value)));
}

void DeclarationCheck::group(const Parameter& what,
                             const std::function<void(Parameters&)>& members) {
  Node* const node = declare(what);
  Node aside;  // a required group's members are declared too, though their values do not count
  Node& into = node != nullptr ? *node : aside;
  into.kind = Node::Kind::kMap;
  describe_into(into, [&] { members(*this); });
}

// Whether the check holds is the reader's business: it decides what may be read.
void DeclarationCheck::check(std::string_view key, bool /*holds*/, std::string_view message) {
  if (message.empty()) findings_.add("a check at '{}' has no message", key);
}

void DeclarationCheck::choice_index(const Parameter& what, std::size_t& index,
                                    std::span<const std::string_view> names) {
  Node* const node = declare(what);
  if (names.empty()) findings_.add("parameter '{}' is a choice of nothing", what.key);
  if (node != nullptr && index < names.size()) *node = scalar(std::string(names[index]));
}

void DeclarationCheck::list_elements(const Parameter& what, Elements& elements, Range<int> count) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  check_count(what, elements.size(), count);
  node->kind = Node::Kind::kSequence;
  node->items.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    describe_into(node->items[i], [&] { elements.describe(i, *this); });
  }
}

void DeclarationCheck::color_elements(const Parameter& what, ColorElements& elements,
                                      Range<int> count) {
  Node* const node = declare(what);
  if (node == nullptr) return;
  check_count(what, elements.size(), count);
  node->kind = Node::Kind::kMap;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Label label = elements.label(i);
    if (label == kBackground || label >= palette_.size()) {
      findings_.add("parameter '{}' has label {} by default, expected colours of the palette",
                    what.key, label);
      continue;
    }
    node->entries.push_back({std::string(palette_.name(label)), {}, {}});
    describe_into(node->entries.back().value, [&] { elements.describe(i, *this); });
  }
}

Parameters::OptionalOutcome DeclarationCheck::optional_value(
    const Parameter& what, bool has_default, const std::function<void()>& describe_value) {
  if (has_default) {
    describe_value();
  } else if (Node* node = declare(what)) {
    *node = scalar("none");
  }
  return OptionalOutcome::kUnchanged;
}

}  // namespace maggic::testing
