#include "studio/server/page_files.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace maggic::studio {
namespace {

void answer_page_file(const PageFile& file, const httplib::Request& request,
                      httplib::Response& response) {
  const std::string tag = fmt::format("\"{}\"", file.sha256.substr(0, 32));
  response.set_header("ETag", tag);
  response.set_header("Cache-Control", "no-cache");
  const std::string known = request.get_header_value("If-None-Match");
  if (known == "*" || known.find(tag) != known.npos) {
    response.status = 304;
    return;
  }
  response.status = 200;
  response.set_content(file.content.data(), file.content.size(), std::string(mime_type(file.path)));
}

}  // namespace

std::string_view mime_type(std::string_view path) {
  using Entry = std::pair<std::string_view, std::string_view>;
  static constexpr std::array kTypes{
      Entry{".html", "text/html; charset=utf-8"},
      Entry{".css", "text/css; charset=utf-8"},
      Entry{".mjs", "text/javascript; charset=utf-8"},
      Entry{".js", "text/javascript; charset=utf-8"},
      Entry{".json", "application/json"},
      Entry{".svg", "image/svg+xml"},
      Entry{".png", "image/png"},
      Entry{".ico", "image/x-icon"},
      Entry{".woff2", "font/woff2"},
      Entry{".webmanifest", "application/manifest+json"},
  };
  const auto* found = std::ranges::find_if(
      kTypes, [path](const Entry& entry) { return path.ends_with(entry.first); });
  return found == kTypes.end() ? std::string_view() : found->second;
}

void add_page_routes(Routes& routes) {
  for (const PageFile& file : page_files()) {
    const auto handler = [&file](const httplib::Request& request, std::string_view,
                                 httplib::Response& response) {
      answer_page_file(file, request, response);
    };
    routes.add("GET", fmt::format("/{}", file.path), handler);
    if (file.path == "index.html") routes.add("GET", "/", handler);
  }
}

}  // namespace maggic::studio
