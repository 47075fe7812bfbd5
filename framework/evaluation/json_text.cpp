#include "evaluation/json_text.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "maggic/config_error.hpp"

namespace maggic {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxDepth = 64;

/// Walks through the text once to find where it goes wrong; the tree is built afterwards. (The
/// parser's own exceptions do not all tell the place, and it takes duplicate keys silently.)
class Proofreader final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return enter(); }
  bool end_array() override { return leave(); }
  bool start_object(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }

  bool key(string_t& name) override {
    if (keys_.back().insert(name).second) return true;
    message = fmt::format("the key {} occurs twice in one object", quoted_excerpt(name));
    return false;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    offset = position;
    // 406: a number beyond the range of a double; everything else is not JSON at all.
    const std::string last = quoted_excerpt(token);
    message = error.id == 406
                  ? fmt::format("found {}, expected a number that is not so large", last)
                  : fmt::format("this is not JSON; what was read last is {}", last);
    return false;
  }

  std::optional<std::size_t> offset;  ///< Bytes read when the mistake was found.
  std::string message;

 private:
  bool enter() {
    keys_.emplace_back();
    if (keys_.size() <= kMaxDepth) return true;
    message = fmt::format("lists and objects are nested more than {} deep", kMaxDepth);
    return false;
  }
  bool leave() {
    keys_.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> keys_;
};

/// Where the byte before `offset`, the last one read, stands.
Mistake mistake_before(std::string_view text, std::size_t offset, std::string_view file_name,
                       std::string message) {
  const std::string_view read = text.substr(0, offset == 0 ? 0 : offset - 1);
  const auto is_start = [](char c) { return (c & 0xC0) != 0x80; };  // of a UTF-8 character
  const std::string_view line = read.substr(read.rfind('\n') + 1);
  return {std::string(file_name), static_cast<int>(std::ranges::count(read, '\n')) + 1,
          static_cast<int>(std::ranges::count_if(line, is_start)) + 1, std::move(message)};
}

}  // namespace

Json parse_json(std::string_view text, std::string_view file_name) {
  Proofreader reader;
  if (!Json::sax_parse(text, &reader)) {
    if (!reader.offset) {
      throw ConfigError({{std::string(file_name), 0, 0, reader.message}});
    }
    throw ConfigError({mistake_before(text, *reader.offset, file_name, reader.message)});
  }
  return Json::parse(text);
}

}  // namespace maggic
