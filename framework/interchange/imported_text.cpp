#include <filesystem>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "interchange/imported_blocks.hpp"

namespace maggic {

std::string source_text(const Place& place) {
  // A file's name may hold anything, line breaks too.
  std::string name = quoted_excerpt(std::filesystem::path(place.file).filename().string());
  name = name.substr(1, name.size() - 2);
  return place.line > 0 ? fmt::format("{}:{}", name, place.line) : name;
}

std::string commented_line(std::string_view code, std::string_view comment) {
  return fmt::format("{:<24}  # {}\n", code, comment);
}

}  // namespace maggic
