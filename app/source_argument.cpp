#include "app/source_argument.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "maggic/picture_name.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_camera(std::string_view argument) {
  return (!argument.empty() && std::ranges::all_of(argument, is_digit)) ||
         argument.starts_with("/dev/video") || argument.starts_with("/dev/v4l/");
}

bool is_url(std::string_view argument) {
  const std::size_t end = argument.find("://");
  if (end == std::string_view::npos || end == 0 || !is_letter(argument[0])) return false;
  return std::ranges::all_of(argument.substr(0, end), [](char c) {
    return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '.';
  });
}

Node map_of(std::string key, Node value, const Place& place) {
  Node map;
  map.kind = Node::Kind::kMap;
  map.place = place;
  map.entries.push_back({std::move(key), place, std::move(value)});
  return map;
}

/// `{plugin: {key: text}}`.
Node source_node(const char* plugin, const char* key, std::string_view text) {
  const Place place{"--source", 0, 0};
  Node value;
  value.kind = Node::Kind::kScalar;
  value.place = place;
  value.scalar = text;
  value.quoted = true;  // text, even if it looks like a number
  return map_of(plugin, map_of(key, std::move(value), place), place);
}

/// `{plugin: {}}`.
Node source_node(const char* plugin) {
  const Place place{"--source", 0, 0};
  Node no_parameters;
  no_parameters.kind = Node::Kind::kMap;
  no_parameters.place = place;
  return map_of(plugin, std::move(no_parameters), place);
}

}  // namespace

Node source_from_argument(std::string_view argument) {
  if (argument == "synthetic") return source_node("synthetic_match");
  if (is_camera(argument)) return source_node("camera", "device", argument);
  if (is_url(argument)) return source_node("video", "path", argument);

  std::error_code ignored;
  const fs::path path(argument);
  if (fs::exists(path, ignored)) {
    const bool pictures = fs::is_directory(path, ignored) || has_picture_extension(path);
    return source_node(pictures ? "images" : "video", "path", argument);
  }
  if (argument.find_first_of("*?") != std::string_view::npos) {
    return source_node("images", "path", argument);
  }
  throw std::invalid_argument(fmt::format(
      "--source: there is no file or folder '{}' (expected a camera such as 0 or /dev/video0, a "
      "video file, a picture, a folder of pictures, a pattern such as 'shots/*.png', a stream such "
      "as rtsp://camera/live, or synthetic)",
      argument));
}

}  // namespace maggic::app
