#include "config/yaml_writer.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "config/characters.hpp"

namespace maggic {
namespace {

/// Where a scalar is written: flow collections take fewer plain characters.
enum class Context { kBlock, kFlow };

bool reads_as_null(std::string_view text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

/// Whether `text` is read back as it is without quotes. Errs on the side of quotes.
bool can_stand_plain(std::string_view text, Context context) {
  if (reads_as_null(text) || text == "<<") return false;
  if (text.front() == ' ' || text.back() == ' ' || text.back() == ':') return false;
  if (text.starts_with("---") || text.starts_with("...")) return false;
  const bool may_start_dashed = text.size() > 1 && text[0] == '-' && text[1] != ' ';
  if (std::string_view("-?:,[]{}#&*!|>'\"%@`").find(text.front()) != std::string_view::npos &&
      !may_start_dashed) {
    return false;
  }
  const std::string_view refused = context == Context::kFlow ? ",[]{}?:#" : "";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (invisible_length(text.substr(i)) != 0) return false;
    if (refused.find(text[i]) != std::string_view::npos) return false;
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    if ((text[i] == ':' && next == ' ') || (text[i] == ' ' && next == '#')) return false;
  }
  return true;
}

std::string double_quoted(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (const std::size_t length = invisible_length(text.substr(i)); length != 0) {
      out += escaped(text.substr(i, length));
      i += length - 1;
      continue;
    }
    if (text[i] == '"' || text[i] == '\\') out += '\\';
    out += text[i];
  }
  return out + '"';
}

std::string scalar_text(const Node& node, Context context) {
  const bool plain = !node.quoted && can_stand_plain(node.scalar, context);
  return plain ? node.scalar : double_quoted(node.scalar);
}

std::string key_text(std::string_view key, Context context) {
  return can_stand_plain(key, context) ? std::string(key) : double_quoted(key);
}

/// A plain scalar that would need quotes inside a flow list, and come back as quoted text.
bool must_stay_in_block(const Node& scalar) {
  return !scalar.quoted && can_stand_plain(scalar.scalar, Context::kBlock) &&
         !can_stand_plain(scalar.scalar, Context::kFlow);
}

/// Points, spans and short lists read better on one line.
bool fits_one_line(const Node& node) {
  if (node.kind == Node::Kind::kMap) return node.entries.empty();
  if (node.kind != Node::Kind::kSequence) return true;
  constexpr std::size_t kMostItems = 8;
  return node.items.size() <= kMostItems && std::ranges::all_of(node.items, [](const Node& item) {
           return item.kind == Node::Kind::kScalar && item.scalar.size() <= 16 &&
                  !must_stay_in_block(item);
         });
}

/// Writes `node` after "key:" or "-", which end the current line of `out`.
void append_block(const Node& node, std::size_t indent, std::string& out);

void append_entries(const Node& node, std::size_t indent, std::string& out) {
  const std::string margin(indent, ' ');
  for (const Node::Entry& entry : node.entries) {
    out += margin + key_text(entry.key, Context::kBlock) + ':';
    append_block(entry.value, indent + 2, out);
  }
  for (const Node& item : node.items) {
    out += margin + '-';
    append_block(item, indent + 2, out);
  }
}

void append_block(const Node& node, std::size_t indent, std::string& out) {
  if (node.kind == Node::Kind::kScalar) {
    out += ' ' + scalar_text(node, Context::kBlock) + '\n';
  } else if (fits_one_line(node)) {
    out += ' ' + to_flow_yaml(node) + '\n';
  } else {
    out += '\n';
    append_entries(node, indent, out);
  }
}

}  // namespace

std::string to_flow_yaml(const Node& node) {
  std::string out;
  switch (node.kind) {
    case Node::Kind::kNull: return "~";
    case Node::Kind::kScalar: return scalar_text(node, Context::kFlow);
    case Node::Kind::kSequence:
      for (const Node& item : node.items) {
        out += (out.empty() ? "" : ", ") + to_flow_yaml(item);
      }
      return '[' + out + ']';
    case Node::Kind::kMap:
      for (const Node::Entry& entry : node.entries) {
        out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", key_text(entry.key, Context::kFlow),
                           to_flow_yaml(entry.value));
      }
      return '{' + out + '}';
  }
  return out;
}

std::string to_yaml(const Node& root) {
  std::string out;
  if (root.kind == Node::Kind::kScalar) return scalar_text(root, Context::kBlock) + '\n';
  if (fits_one_line(root)) return to_flow_yaml(root) + '\n';
  append_entries(root, 0, out);
  return out;
}

}  // namespace maggic
