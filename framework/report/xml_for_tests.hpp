#pragma once
/// As much of XML as tests of our own SVG need: strict about what is well-formed.

#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace maggic {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< Its own; entities as they stand.
};

/// The elements of a document in the order they begin; nothing when it is not well-formed.
class XmlReader {
 public:
  static std::optional<std::vector<XmlElement>> read(std::string_view document) {
    XmlReader reader(document);
    if (!reader.read_all()) return std::nullopt;
    return reader.elements_;
  }

 private:
  explicit XmlReader(std::string_view rest) : rest_(rest) {}

  bool read_all() {
    do {
      if (!read_tag()) return false;
      const std::size_t end = std::min(rest_.find('<'), rest_.size());
      const std::string_view text = rest_.substr(0, end);
      if (!is_text(text)) return false;
      if (open_.empty()) {
        return text.find_first_not_of("\n ") == text.npos && end == rest_.size();
      }
      elements_[open_.back()].text += text;
      rest_.remove_prefix(end);
    } while (!rest_.empty());
    return false;
  }

  bool take(std::string_view what) {
    if (!rest_.starts_with(what)) return false;
    rest_.remove_prefix(what.size());
    return true;
  }

  std::string take_name() {
    std::size_t end = 0;
    while (end < rest_.size() &&
           (std::isalnum(static_cast<unsigned char>(rest_[end])) != 0 || rest_[end] == '-')) {
      ++end;
    }
    std::string name(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return name;
  }

  bool read_tag() {
    if (!take("<")) return false;
    if (take("/")) {
      if (open_.empty() || take_name() != elements_[open_.back()].name) return false;
      open_.pop_back();
      return take(">");
    }
    XmlElement element{take_name(), {}, {}};
    if (element.name.empty()) return false;
    while (take(" ")) {
      const std::string key = take_name();
      if (key.empty() || !take("=\"")) return false;
      const std::size_t end = rest_.find('"');
      if (end == rest_.npos) return false;
      const std::string_view value = rest_.substr(0, end);
      if (!is_text(value) || !element.attributes.emplace(key, value).second) return false;
      rest_.remove_prefix(end + 1);
    }
    const bool is_closed = take("/");
    if (!is_closed) open_.push_back(elements_.size());
    elements_.push_back(std::move(element));
    return take(">");
  }

  /// No raw `<`, no `&` but of the five entities, no control characters.
  static bool is_text(std::string_view text) {
    static const std::set<std::string_view> kEntities{"amp", "lt", "gt", "quot", "apos"};
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '<' || (static_cast<unsigned char>(text[i]) < 32 && text[i] != '\n')) {
        return false;
      }
      if (text[i] != '&') continue;
      const std::size_t end = text.find(';', i);
      if (end == text.npos || !kEntities.contains(text.substr(i + 1, end - i - 1))) return false;
    }
    return true;
  }

  std::string_view rest_;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_;
};

}  // namespace maggic
