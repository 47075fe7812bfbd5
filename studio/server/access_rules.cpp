#include "studio/server/access_rules.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <random>
#include <ranges>
#include <utility>

#include <fmt/format.h>

namespace maggic::studio {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Whether `text`, and not only what stands before a NUL in it, is a numeric address.
bool is_address(int family, std::string_view text) {
  in6_addr parsed{};
  return text.find('\0') == text.npos &&
         ::inet_pton(family, std::string(text).c_str(), &parsed) == 1;
}

bool is_ipv4(std::string_view text) { return is_address(AF_INET, text); }
bool is_ipv6(std::string_view text) { return is_address(AF_INET6, text); }

/// An address as it stands in a URL.
std::string in_url(std::string_view address) {
  return is_ipv6(address) ? fmt::format("[{}]", address) : lower(address);
}

bool is_number_in_url(std::string_view host) {
  if (host.starts_with('[') && host.ends_with(']')) return is_ipv6(host.substr(1, host.size() - 2));
  return is_ipv4(host);
}

}  // namespace

AccessRules::AccessRules(std::string_view listen_address, int port, std::string token)
    : port_(std::to_string(port)),
      names_{"localhost", "127.0.0.1", "[::1]", in_url(listen_address)},
      any_number_(listen_address == "0.0.0.0" || listen_address == "::"),
      token_(std::move(token)),
      cookie_name_(fmt::format("maggic_studio_{}", port)) {}

bool AccessRules::is_us(std::string_view host_and_port) const {
  const std::string text = lower(host_and_port);
  std::string_view host = text;
  // The colons of an address in brackets are no port's.
  const auto colon = host.find(':', host.find(']') == host.npos ? 0 : host.find(']'));
  if (colon != host.npos) {
    if (host.substr(colon + 1) != port_) return false;
    host = host.substr(0, colon);
  } else if (port_ != "80") {
    return false;
  }
  return std::ranges::find(names_, host) != names_.end() || (any_number_ && is_number_in_url(host));
}

bool AccessRules::is_token(std::string_view text) const {
  if (text.size() != token_.size()) return false;
  // Takes the same time wherever they differ.
  unsigned difference = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    difference |= static_cast<unsigned char>(text[i]) ^ static_cast<unsigned char>(token_[i]);
  }
  return difference == 0;
}

bool AccessRules::has_token(const RequestOrigin& request) const {
  constexpr std::string_view kBearer = "Bearer ";
  for (const std::string& value : request.authorization) {
    if (value.starts_with(kBearer) && is_token(std::string_view(value).substr(kBearer.size()))) {
      return true;
    }
  }
  for (const std::string& line : request.cookie) {
    for (const auto part : std::views::split(line, ';')) {
      std::string_view pair(part.begin(), part.end());
      pair.remove_prefix(std::min(pair.find_first_not_of(' '), pair.size()));
      const auto equals = pair.find('=');
      if (equals != pair.npos && pair.substr(0, equals) == cookie_name_ &&
          is_token(pair.substr(equals + 1))) {
        return true;
      }
    }
  }
  return false;
}

Access AccessRules::judge(const RequestOrigin& request, bool of_api) const {
  if (request.host.size() != 1 || !is_us(request.host.front())) return Access::kForbidden;
  const std::string us = "http://" + lower(request.host.front());
  for (const std::string& origin : request.origin) {
    if (lower(origin) != us) return Access::kForbidden;
  }
  for (const std::string& site : request.fetch_site) {
    if (of_api && site != "same-origin" && site != "none") return Access::kForbidden;
  }
  if (token_.empty() || has_token(request)) return Access::kGranted;
  const bool by_parameter =
      request.token_parameter.size() == 1 && is_token(request.token_parameter.front());
  return by_parameter ? Access::kGrantedByParameter : Access::kTokenMissing;
}

std::string AccessRules::cookie() const {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name_, token_);
}

bool is_loopback(std::string_view address) {
  return lower(address) == "localhost" || address == "::1" ||
         (is_ipv4(address) && address.starts_with("127."));
}

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", static_cast<std::uint32_t>(random()));
  return token;
}

}  // namespace maggic::studio
