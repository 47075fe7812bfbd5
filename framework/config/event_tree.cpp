#include "config/event_tree.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/mark.h>

#include "config/characters.hpp"
#include "config/wording.hpp"

namespace maggic {
namespace {

/// yaml-cpp 0.7 turns the escapes \N and \_ into bytes that are no UTF-8.
bool is_storable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || text.front() == '\0') return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

PlaceFinder::PlaceFinder(std::string_view text, std::string_view file_name)
    : file_(file_name), line_starts_{0} {
  characters_before_.reserve(text.size() + 1);
  int characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    characters_before_.push_back(characters);
    if (!is_continuation(text[i])) ++characters;
    if (text[i] == '\n') line_starts_.push_back(i + 1);
  }
  characters_before_.push_back(characters);
}

Place PlaceFinder::at(int line, int byte_column) const {
  if (line < 0) return {file_, 0, 0};
  const std::size_t index = std::min(static_cast<std::size_t>(line), line_starts_.size() - 1);
  const std::size_t start = line_starts_[index];
  const std::size_t here = std::min(start + static_cast<std::size_t>(std::max(byte_column, 0)),
                                    characters_before_.size() - 1);
  return {file_, static_cast<int>(index) + 1,
          characters_before_[here] - characters_before_[start] + 1};
}

void EventTree::OnDocumentStart(const YAML::Mark& mark) {
  if (started_) stop(place(mark), "found more after the end of the document, expected only one");
  started_ = true;
}

void EventTree::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  if (key_is_due()) {
    refuse_key(place(mark), "nothing");
    keep_anchor(anchor, {});
    return;
  }
  Subtree tree;
  // yaml-cpp places the value that is missing after `key:` at whatever follows it.
  tree.node.place = open_.empty() ? place(mark) : place_of_parent();
  charge(tree.cost, tree.node.place);
  add(std::move(tree), anchor);
}

void EventTree::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  if (key_is_due()) {
    refuse_key(place(mark), "an alias");
    return;
  }
  const Anchored& target = anchors_[anchor];
  if (!target.complete) {
    note(place(mark), "found an alias to a node that contains it, expected no cycles");
    Subtree nothing;
    nothing.node.place = place(mark);
    add(std::move(nothing), 0);
    return;
  }
  // Charged before it is copied: the copies are what a billion laughs is made of.
  if (target.tree.cost.height + open_.size() > limits_.max_depth) {
    stop(place(mark), fmt::format("found nodes nested more than {} deep once aliases are written "
                                  "out, expected less",
                                  limits_.max_depth));
  }
  charge(target.tree.cost, place(mark));
  add(target.tree, 0);
}

void EventTree::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         const std::string& value) {
  const Place here = place(mark);
  const bool quoted = tag == "!";
  if (!quoted) reject_tag(here, tag);
  if (!is_storable(value)) {
    note(here, "found an escape for NUL, \\N or \\_, expected text without them");
  }
  Subtree tree;
  tree.node.kind = Node::Kind::kScalar;
  tree.node.place = here;
  tree.node.scalar = value;
  tree.node.quoted = quoted;
  tree.cost.bytes = value.size();
  charge(tree.cost, here);
  if (key_is_due()) {
    take_key(here, value, quoted);
    keep_anchor(anchor, tree);
    return;
  }
  add(std::move(tree), anchor);
}

void EventTree::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) {
  open(Node::Kind::kSequence, mark, tag, anchor);
}

void EventTree::OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           YAML::EmitterStyle::value /*style*/) {
  open(Node::Kind::kMap, mark, tag, anchor);
}

Place EventTree::place(const YAML::Mark& mark) const {
  if (mark.is_null() && !open_.empty()) return place_of_parent();
  return places_.at(mark.line, mark.column);
}

const Place& EventTree::place_of_parent() const {
  const Open& parent = open_.back();
  return parent.has_key ? parent.key_place : parent.tree.node.place;
}

void EventTree::note(const Place& place, std::string message) {
  mistakes_.push_back(mistake_at(place, std::move(message)));
}

void EventTree::stop(const Place& place, std::string message) {
  note(place, std::move(message));
  throw ReadingEnded{};
}

void EventTree::reject_tag(const Place& place, const std::string& tag) {
  if (tag.empty() || tag == "?") return;
  note(place, fmt::format("found the tag {}, expected a value without a tag", quoted_excerpt(tag)));
}

bool EventTree::key_is_due() const {
  return !open_.empty() && open_.back().tree.node.kind == Node::Kind::kMap && !open_.back().has_key;
}

void EventTree::take_key(const Place& place, const std::string& text, bool quoted) {
  constexpr std::size_t kLongestKey = 256;  // yaml-cpp reads simple keys up to 1024 only.
  Open& map = open_.back();
  map.has_key = true;
  map.drops_value = true;
  map.key = text;
  map.key_place = place;
  if (text == "<<" && !quoted) {
    note(place, "found the merge key '<<', expected the values to be written out");
    return;
  }
  if (text.size() > kLongestKey) {
    note(place,
         fmt::format("found a key of {} bytes, expected at most {}", text.size(), kLongestKey));
    return;
  }
  const auto [first, is_new] = map.keys.try_emplace(text, place);
  if (!is_new) {
    note(place, fmt::format("found the key {} again, expected it once (first at {}:{}:{})",
                            quoted_excerpt(text), first->second.file, first->second.line,
                            first->second.column));
    return;
  }
  map.drops_value = false;
}

void EventTree::refuse_key(const Place& place, std::string_view found) {
  note(place, fmt::format("found {} as a key, expected text", found));
  Open& map = open_.back();
  map.has_key = true;
  map.drops_value = true;
  map.key_place = place;
}

void EventTree::open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
                     YAML::anchor_t anchor) {
  const Place here = place(mark);
  if (tag != "!") reject_tag(here, tag);
  if (open_.size() >= limits_.max_depth) {
    stop(here,
         fmt::format("found nodes nested more than {} deep, expected less", limits_.max_depth));
  }
  Open opened;
  opened.is_key = key_is_due();
  if (opened.is_key) refuse_key(here, kind == Node::Kind::kMap ? "a map" : "a list");
  opened.tree.node.kind = kind;
  opened.tree.node.place = here;
  opened.anchor = anchor;
  charge(opened.tree.cost, here);
  if (anchor != 0) anchors_[anchor] = {};
  open_.push_back(std::move(opened));
}

void EventTree::close() {
  Open closed = std::move(open_.back());
  open_.pop_back();
  if (closed.is_key) {
    keep_anchor(closed.anchor, closed.tree);
    return;
  }
  add(std::move(closed.tree), closed.anchor);
}

void EventTree::add(Subtree tree, YAML::anchor_t anchor) {
  keep_anchor(anchor, tree);
  if (open_.empty()) {
    root_ = std::move(tree.node);
    return;
  }
  Open& parent = open_.back();
  Cost& cost = parent.tree.cost;
  cost.nodes += tree.cost.nodes;
  cost.bytes += tree.cost.bytes + parent.key.size();
  cost.height = std::max(cost.height, tree.cost.height + 1);
  if (parent.tree.node.kind == Node::Kind::kSequence) {
    parent.tree.node.items.push_back(std::move(tree.node));
    return;
  }
  parent.has_key = false;
  if (parent.drops_value) return;
  parent.tree.node.entries.push_back(
      {std::move(parent.key), std::move(parent.key_place), std::move(tree.node)});
  parent.key.clear();
}

void EventTree::keep_anchor(YAML::anchor_t anchor, const Subtree& tree) {
  if (anchor == 0) return;
  charge(tree.cost, tree.node.place);  // A copy is held, so nested anchors must not come free.
  anchors_[anchor] = {tree, true};
}

void EventTree::charge(const Cost& cost, const Place& place) {
  nodes_ += cost.nodes;
  bytes_ += cost.bytes;
  if (nodes_ > limits_.max_nodes) {
    stop(place, fmt::format("found more than {} nodes once aliases are written out, expected less",
                            limits_.max_nodes));
  }
  if (bytes_ > 2 * limits_.max_bytes) {
    stop(place, fmt::format("found more than {} bytes of text once aliases are written out, "
                            "expected less",
                            2 * limits_.max_bytes));
  }
}

}  // namespace maggic
