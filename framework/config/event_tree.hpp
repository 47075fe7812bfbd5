#pragma once
/// From yaml-cpp's events to a tree of nodes, with every restriction of document.hpp enforced.

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <yaml-cpp/eventhandler.h>

#include "maggic/document.hpp"

namespace maggic {

/// Turns yaml-cpp's marks (from 0, in bytes) into places (from 1, in characters).
class PlaceFinder {
 public:
  PlaceFinder(std::string_view text, std::string_view file_name);

  /// @param line, byte_column from 0; a negative line gives the file as a whole.
  Place at(int line, int byte_column) const;

 private:
  std::string file_;
  std::vector<std::size_t> line_starts_;
  std::vector<int> characters_before_;  ///< Each byte: counting them anew is slow on long lines.
};

/// Thrown through yaml-cpp after a mistake that ends the reading.
struct ReadingEnded {};

/// Builds the tree of one document. Mistakes are collected; only a limit or a second document ends
/// the reading early.
class EventTree final : public YAML::EventHandler {
 public:
  EventTree(const PlaceFinder& places, const DocumentLimits& limits, std::vector<Mistake>& mistakes)
      : places_(places), limits_(limits), mistakes_(mistakes) {}

  Node take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  /// What a subtree costs once its aliases are written out.
  struct Cost {
    std::size_t nodes = 1;
    std::size_t bytes = 0;
    std::size_t height = 1;
  };
  /// A node with its cost.
  struct Subtree {
    Node node;
    Cost cost;
  };
  /// A sequence or map that is still being read.
  struct Open {
    Subtree tree;
    YAML::anchor_t anchor = 0;
    bool is_key = false;       ///< Stands where a key should be.
    bool has_key = false;      ///< Of a map: the next node is a value.
    bool drops_value = false;  ///< The key was a mistake.
    std::string key;
    Place key_place;
    std::unordered_map<std::string, Place> keys;  ///< Of a map, for repetitions.
  };
  struct Anchored {
    Subtree tree;
    bool complete = false;
  };

  Place place(const YAML::Mark& mark) const;
  /// Of the key, or the list, that the next node belongs to.
  const Place& place_of_parent() const;
  void note(const Place& place, std::string message);
  [[noreturn]] void stop(const Place& place, std::string message);
  void reject_tag(const Place& place, const std::string& tag);
  bool key_is_due() const;
  void take_key(const Place& place, const std::string& text, bool quoted);
  void refuse_key(const Place& place, std::string_view found);
  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor);
  void close();
  void add(Subtree tree, YAML::anchor_t anchor);
  void keep_anchor(YAML::anchor_t anchor, const Subtree& tree);
  void charge(const Cost& cost, const Place& place);

  const PlaceFinder& places_;
  const DocumentLimits& limits_;
  std::vector<Mistake>& mistakes_;
  Node root_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  std::size_t bytes_ = 0;
  bool started_ = false;
};

}  // namespace maggic
