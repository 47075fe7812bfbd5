#include "studio/session/node_json.hpp"

#include <string>
#include <utility>

namespace maggic::studio {
namespace {

nlohmann::json scalar_to_json(const Node& node) {
  if (node.quoted) return node.scalar;
  // What JSON reads as a number or a truth value is one in YAML too.
  nlohmann::json read = nlohmann::json::parse(node.scalar, nullptr, false);
  if (read.is_number() || read.is_boolean()) return read;
  return node.scalar;
}

}  // namespace

nlohmann::json to_json(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull: return nullptr;
    case Node::Kind::kScalar: return scalar_to_json(node);
    case Node::Kind::kSequence: {
      nlohmann::json items = nlohmann::json::array();
      for (const Node& item : node.items) items.push_back(to_json(item));
      return items;
    }
    case Node::Kind::kMap: break;
  }
  nlohmann::json map = nlohmann::json::object();
  for (const Node::Entry& entry : node.entries) map[entry.key] = to_json(entry.value);
  return map;
}

// JSON is YAML.
Node to_node(const nlohmann::json& json, std::string_view file_name) {
  return parse_document(json.dump(), file_name);
}

}  // namespace maggic::studio
