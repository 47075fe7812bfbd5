#pragma once
/// The files of studio/page, built into the program.

#include <span>
#include <string_view>

#include <httplib.h>

#include "studio/server/routes.hpp"

namespace maggic::studio {

struct PageFile {
  std::string_view path;  ///< Below studio/page, such as `icons/save.svg`.
  std::string_view content;
  std::string_view sha256;  ///< Of the content, hexadecimal.
};

/// All of them; written by embed_files.cmake.
std::span<const PageFile> page_files();

/// As browsers have to be told what a file is; by its ending. Empty for one that is not known.
std::string_view mime_type(std::string_view path);

/// Every page file under its own path, and `index.html` under `/` too. Browsers keep what they have
/// got, but ask each time whether it is still the same.
void add_page_routes(Routes& routes);

}  // namespace maggic::studio
