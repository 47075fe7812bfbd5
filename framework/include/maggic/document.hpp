#pragma once
/// YAML as a tree that remembers where everything stood.
///
/// A strict subset of YAML 1.2 read through yaml-cpp's event parser: duplicate keys, merge keys
/// (`<<`), custom tags, non-scalar keys, several documents in a file, aliases that refer to
/// themselves and files that grow without bound by aliases are errors, each with its place. So are
/// bytes that are no UTF-8 and control characters.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/config_error.hpp"

namespace maggic {

/// Where a node stood. `file` is text owned by value, because nodes of several files live in one
/// tree after a merge.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// A null, a scalar, a sequence or a map.
class Node {
 public:
  enum class Kind { kNull, kScalar, kSequence, kMap };
  struct Entry;

  Kind kind = Kind::kNull;
  Place place;
  std::string scalar;          ///< Text of a scalar, unquoted.
  bool quoted = false;         ///< A quoted scalar is text even if it looks like a number.
  std::vector<Node> items;     ///< Of a sequence.
  std::vector<Entry> entries;  ///< Of a map, in file order, keys unique.

  /// The value under `key` of a map; null pointer when it is absent or this is no map.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  /// Puts `value` under `key`, in the place of what is there or behind all others; what is no map
  /// becomes one. @return where it stands now.
  Node& set(std::string_view key, Node value);
};

struct Node::Entry {
  std::string key;
  Place key_place;
  Node value;
};

/// Limits that keep hostile files harmless.
struct DocumentLimits {
  std::size_t max_bytes = 1 << 20;
  std::size_t max_nodes = 100'000;  ///< After aliases are expanded.
  std::size_t max_depth = 64;
};

/// @param file_name as shown in messages.
/// @return the root; an empty document is a null node.
/// @throws ConfigError with every mistake that can be told after the first.
Node parse_document(std::string_view text, std::string_view file_name,
                    const DocumentLimits& limits = {});

/// Reads and parses a file. @throws ConfigError also when it cannot be read, is a directory, or
/// is not text.
Node load_document(const std::filesystem::path& file, const DocumentLimits& limits = {});

/// Lays `over` on `base`: maps are merged key by key, anything else replaces what was there, and
/// `key: ~` removes a key. An `over` that is null as a whole (an empty file) changes nothing.
/// Places follow their nodes.
void merge_document(Node& base, const Node& over);

/// Applies `path.to.key=value`, the value being YAML (so lists and maps work). A path element
/// that is a number indexes a sequence. Missing maps on the way are made; an empty value or `~`
/// removes what stands there.
/// @throws ConfigError (file `--set`) when the text has no `=`, or the path runs through a scalar.
void set_in_document(Node& root, std::string_view assignment);

/// The tree as YAML again, with stable formatting; parse_document of it gives the same tree, but
/// that text which cannot stand without quotes comes back as quoted.
std::string to_yaml(const Node& root);

}  // namespace maggic
