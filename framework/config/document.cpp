#include "maggic/document.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "config/characters.hpp"
#include "config/event_tree.hpp"
#include "config/wording.hpp"
#include "files/text_file.hpp"

namespace maggic {
namespace {

/// Where `text` stops being text. yaml-cpp guesses encodings, takes byte 4 for the end of the file
/// and replaces what it cannot read, so nothing of that kind may reach it.
std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const std::size_t length = utf8_length(rest);
    const bool is_line_layout = text[i] == '\t' || text[i] == '\n';
    if (length == 0 || (!is_line_layout && invisible_length(rest) != 0)) return i;
    i += length;
  }
  return std::nullopt;
}

constexpr const char* kEnd = "...\n";

/// Without byte order mark, lines ended by '\n' alone, and with an explicit end: yaml-cpp takes a
/// single quote that is never closed for text up to the end of the file, but not across `...`.
std::string normalized_text(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    out += text[i];
  }
  if (!out.empty() && out.back() != '\n') out += '\n';
  return out + kEnd;
}

/// What yaml-cpp says, in words of this house where its own are hard to act on.
std::string in_plain_words(const std::string& message) {
  namespace Said = YAML::ErrorMsg;
  if (message == Said::DOC_IN_SCALAR) return "found the end inside quotes, expected them closed";
  if (message == Said::END_OF_SEQ_FLOW) return "found no ']' for a '[' above, expected one";
  if (message == Said::END_OF_MAP_FLOW) return "found no '}' for a '{' above, expected one";
  if (message == Said::MAP_VALUE) {
    return "found a ':' where no key can be, expected one 'key: value' a line, evenly indented";
  }
  if (message == Said::END_OF_MAP || message == Said::END_OF_SEQ) {
    return "found a line that is indented unlike those above, expected even indentation";
  }
  if (message == Said::TAB_IN_INDENTATION) {
    return "found a tab as indentation, expected spaces";
  }
  return fmt::format("found no valid YAML: {}", message);
}

void parse_events(const std::string& text, const PlaceFinder& places, EventTree& tree,
                  std::vector<Mistake>& mistakes) {
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(tree)) {
    }
  } catch (const ReadingEnded&) {
    // The mistake is noted already.
  } catch (const YAML::Exception& e) {
    mistakes.push_back(mistake_at(places.at(e.mark.line, e.mark.column), in_plain_words(e.msg)));
  } catch (const std::exception& e) {
    mistakes.push_back(
        mistake_at(places.at(-1, 0), fmt::format("found no valid YAML: {}", e.what())));
  }
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &Entry::key);
  return found == entries.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::set(std::string_view key, Node value) {
  if (kind != Kind::kMap) {
    const Place stood = place;
    *this = Node();
    kind = Kind::kMap;
    place = stood;
  }
  if (Node* known = find(key)) return *known = std::move(value);
  const Place key_place = value.place;
  entries.push_back({std::string(key), key_place, std::move(value)});
  return entries.back().value;
}

Node parse_document(std::string_view text, std::string_view file_name,
                    const DocumentLimits& limits) {
  if (text.size() > limits.max_bytes) {
    throw ConfigError(
        {{std::string(file_name), 0, 0,
          fmt::format("found {} bytes, expected at most {}", text.size(), limits.max_bytes)}});
  }
  const std::string clean = normalized_text(text);
  const PlaceFinder places(clean, file_name);
  if (const std::optional<std::size_t> bad = first_bad_byte(clean)) {
    const std::string_view before = std::string_view(clean).substr(0, *bad);
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto line = std::ranges::count(before, '\n');
    throw ConfigError(
        {mistake_at(places.at(static_cast<int>(line), static_cast<int>(*bad - line_start)),
                    fmt::format("found byte 0x{:02x}, which is no text, expected YAML in UTF-8",
                                static_cast<unsigned char>(clean[*bad])))});
  }

  std::vector<Mistake> mistakes;
  EventTree tree(places, limits, mistakes);
  parse_events(clean, places, tree, mistakes);
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  Node root = tree.take_root();
  if (root.kind == Node::Kind::kNull) root.place = places.at(0, 0);
  return root;
}

Node load_document(const std::filesystem::path& file, const DocumentLimits& limits) {
  return parse_document(read_text_file(file, limits.max_bytes, "YAML file"), file.string(), limits);
}

}  // namespace maggic
