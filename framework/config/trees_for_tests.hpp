#pragma once
/// Random documents for property tests.

#include <string>
#include <utility>
#include <vector>

#include <rapidcheck.h>

#include "maggic/document.hpp"

namespace maggic::trees {

/// Texts that look like something else are the ones that get lost.
inline rc::Gen<std::string> any_text() {
  return rc::gen::oneOf(
      rc::gen::element<std::string>("", "~", "null", "true", "010", "1e5", "<<", "-", "- a", "---",
                                    "...", "a: b", "a:", ":a", "#", "a #b", "[a", "{a}", "a, b",
                                    " a ", "'", "\"", "\\n", "a\nb\n", "\t", "%a", "!t", "&a", "*a",
                                    "?", "? a", "@", "`", "größe", "\x1b[0m", "\xC2\x85", "|", ">",
                                    "http://host:80/a?b=c", "\xEF\xBB\xBF"),
      rc::gen::container<std::string>(rc::gen::inRange(' ', '~')));
}

inline Node scalar(std::string text, bool quoted) {
  Node node;
  node.kind = Node::Kind::kScalar;
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

/// A map or a list of what `value` makes.
inline Node collection(bool is_map, const std::vector<std::pair<std::string, Node>>& members) {
  Node node;
  node.kind = is_map ? Node::Kind::kMap : Node::Kind::kSequence;
  for (const auto& [key, value] : members) {
    if (!is_map) {
      node.items.push_back(value);
    } else if (node.find(key) == nullptr) {
      node.entries.push_back({key, {}, value});
    }
  }
  return node;
}

inline rc::Gen<Node> any_tree(int depth);

inline rc::Gen<std::vector<std::pair<std::string, Node>>> members(int depth) {
  // Few keys, so that merged maps share some.
  const auto key = rc::gen::oneOf(rc::gen::element<std::string>("a", "b", "c"), any_text());
  return rc::gen::resize(6, rc::gen::container<std::vector<std::pair<std::string, Node>>>(
                                rc::gen::pair(key, any_tree(depth - 1))));
}

inline rc::Gen<Node> any_leaf() {
  return rc::gen::oneOf(rc::gen::just(Node()),
                        rc::gen::apply(scalar, any_text(), rc::gen::arbitrary<bool>()));
}

inline rc::Gen<Node> any_tree(int depth) {
  if (depth <= 0) return any_leaf();
  return rc::gen::oneOf(any_leaf(),
                        rc::gen::apply(collection, rc::gen::arbitrary<bool>(), members(depth)));
}

inline rc::Gen<Node> any_map() {
  return rc::gen::apply(collection, rc::gen::just(true), members(2));
}

/// `node` without the map entries that would remove something in a merge.
inline Node without_nulls(Node node) {
  std::erase_if(node.entries,
                [](const Node::Entry& e) { return e.value.kind == Node::Kind::kNull; });
  for (Node::Entry& entry : node.entries) entry.value = without_nulls(std::move(entry.value));
  return node;
}

}  // namespace maggic::trees

namespace rc {
/// A counterexample is best read as YAML.
inline void showValue(const maggic::Node& node, std::ostream& out) { out << maggic::to_yaml(node); }
}  // namespace rc
