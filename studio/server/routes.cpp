#include "studio/server/routes.hpp"

#include <optional>
#include <utility>

namespace maggic::studio {
namespace {

/// What stands for the `*` of `pattern` in `path`; empty where it has none; nothing when they do
/// not match.
std::optional<std::string_view> name_in(std::string_view path, std::string_view pattern) {
  const auto star = pattern.find('*');
  if (star == pattern.npos) {
    return path == pattern ? std::optional(std::string_view()) : std::nullopt;
  }
  const std::string_view before = pattern.substr(0, star);
  const std::string_view after = pattern.substr(star + 1);
  if (path.size() <= before.size() + after.size()) return {};
  if (!path.starts_with(before) || !path.ends_with(after)) return {};
  path.remove_prefix(before.size());
  path.remove_suffix(after.size());
  return path.find('/') == path.npos ? std::optional(path) : std::nullopt;
}

}  // namespace

void Routes::add(std::string method, std::string path, Handler handler) {
  routes_.push_back({std::move(method), std::move(path), std::move(handler)});
}

Routes::Match Routes::find(std::string_view method, std::string_view path) const {
  Match match;
  for (const Route& route : routes_) {
    const auto name = name_in(path, route.path);
    if (!name) continue;
    match.known = true;
    if (!match.methods.empty()) match.methods += ", ";
    match.methods += route.method == "GET" ? "GET, HEAD" : route.method;
    if (route.method == method || (route.method == "GET" && method == "HEAD")) {
      match.handler = &route.handler;
      match.name = *name;
    }
  }
  return match;
}

}  // namespace maggic::studio
