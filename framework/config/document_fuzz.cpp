/// libFuzzer target: whatever the bytes, parsing ends, in a tree or a ConfigError, and what can be
/// parsed survives being written and parsed again.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "maggic/document.hpp"

namespace {

/// The tree as text that does not depend on formatting.
void append_outline(const maggic::Node& node, std::string& out) {
  out += static_cast<char>('0' + static_cast<int>(node.kind));
  out += std::to_string(node.scalar.size()) + ':' + node.scalar;
  for (const maggic::Node& item : node.items) append_outline(item, out);
  for (const maggic::Node::Entry& entry : node.entries) {
    out += '=' + std::to_string(entry.key.size()) + ':' + entry.key;
    append_outline(entry.value, out);
  }
  out += '.';
}

std::string outline(const maggic::Node& node) {
  std::string out;
  append_outline(node, out);
  return out;
}

void expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  maggic::Node root;
  try {
    root = maggic::parse_document(text, "fuzz.yaml");
  } catch (const maggic::ConfigError& e) {
    expect(!e.mistakes().empty());
    return 0;
  }
  const std::string yaml = maggic::to_yaml(root);
  const maggic::Node again = maggic::parse_document(yaml, "again.yaml");
  expect(outline(again) == outline(root));
  expect(maggic::to_yaml(again) == yaml);

  maggic::Node merged = root;
  maggic::merge_document(merged, root);
  try {
    maggic::set_in_document(merged, text);
  } catch (const maggic::ConfigError&) {
  }
  return 0;
}
