#include "studio/server/body_rules.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace maggic::studio {
namespace {

/// A head's length of the body; nothing when it is not told, or not as one number.
std::optional<std::size_t> content_length(const httplib::Request& head) {
  const auto count = head.get_header_value_count("Content-Length");
  if (count == 0) return 0;
  if (count > 1) return {};
  const std::string text = head.get_header_value("Content-Length");
  std::size_t bytes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bytes);
  // More than a number can hold is a length too, only a hopeless one.
  if (error == std::errc::result_out_of_range) return std::numeric_limits<std::size_t>::max();
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return bytes;
}

bool is_json(std::string_view content_type) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == b; };
  const std::string_view type = content_type.substr(0, content_type.find_first_of("; \t"));
  return std::ranges::equal(type, std::string_view("application/json"), same);
}

}  // namespace

std::optional<Refusal> refuse_body(const httplib::Request& head) {
  if (head.has_header("Transfer-Encoding")) {
    return Refusal{411, "a body has to tell its length with Content-Length"};
  }
  const auto bytes = content_length(head);
  if (!bytes) return Refusal{400, "Content-Length has to be one whole number"};
  if (*bytes > kMostBodyBytes) return Refusal{413, "a body may have 256 KiB at most"};
  if (*bytes == 0) return {};
  if (head.method != "PUT" && head.method != "POST") {
    return Refusal{400, "only PUT and POST may have a body"};
  }
  if (head.has_header("Content-Encoding")) return Refusal{415, "a body has to come as it is"};
  if (!is_json(head.get_header_value("Content-Type"))) {
    return Refusal{415, "a body has to be of Content-Type application/json"};
  }
  return {};
}

std::size_t announced_bytes(const httplib::Request& head) {
  constexpr std::size_t kAnyNumber = 64 * kMostBodyBytes;
  if (head.has_header("Transfer-Encoding")) return kAnyNumber;
  return std::min(content_length(head).value_or(kAnyNumber), kAnyNumber);
}

}  // namespace maggic::studio
