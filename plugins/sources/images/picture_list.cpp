#include "picture_list.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <glob.h>

#include "maggic/picture_name.hpp"
#include "natural_order.hpp"

namespace maggic::images {
namespace {

namespace fs = std::filesystem;

void sort_naturally(std::vector<fs::path>& files) {
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    return comes_naturally_before(a.native(), b.native());
  });
}

PictureList pictures_of_folder(const fs::path& folder) {
  PictureList list;
  std::error_code failed;
  fs::directory_iterator entry(folder, failed);
  for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
    const fs::path& file = entry->path();
    std::error_code ignored;
    if (file.filename().native().starts_with('.') || entry->is_directory(ignored)) continue;
    (maggic::has_picture_extension(file) ? list.files : list.passed_over).push_back(file);
  }
  if (failed) {
    throw std::runtime_error(
        fmt::format("cannot list the folder '{}': {}", folder.string(), failed.message()));
  }
  if (list.files.empty()) {
    throw std::runtime_error(
        fmt::format("the folder '{}' holds no picture ({} other files), expected png, jpg, bmp, "
                    "tif or the like",
                    folder.string(), list.passed_over.size()));
  }
  sort_naturally(list.files);
  sort_naturally(list.passed_over);
  return list;
}

PictureList matches_of(const std::string& pattern) {
  // glob(3) also knows [sets], which are ordinary characters to us.
  std::string escaped;
  for (const char c : pattern) {
    if (c == '[' || c == ']' || c == '\\') escaped += '\\';
    escaped += c;
  }
  glob_t found{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> release(&found, [](glob_t* g) { globfree(g); });
  const int outcome = glob(escaped.c_str(), GLOB_NOSORT, nullptr, &found);
  if (outcome != 0 && outcome != GLOB_NOMATCH) {
    throw std::runtime_error(fmt::format("cannot look up the pattern '{}'", pattern));
  }
  PictureList list;
  for (std::size_t i = 0; i < found.gl_pathc; ++i) {
    std::error_code ignored;
    if (!fs::is_directory(found.gl_pathv[i], ignored)) list.files.emplace_back(found.gl_pathv[i]);
  }
  if (list.files.empty()) {
    throw std::runtime_error(fmt::format("no file matches the pattern '{}'", pattern));
  }
  sort_naturally(list.files);
  return list;
}

}  // namespace

PictureList list_pictures(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return pictures_of_folder(path);
  if (fs::exists(path, ignored)) return {{path}, {}};
  if (path.find_first_of("*?") != std::string::npos) return matches_of(path);
  throw std::runtime_error(fmt::format("there is no file or folder '{}'", path));
}

}  // namespace maggic::images
