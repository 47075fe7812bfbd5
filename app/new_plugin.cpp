#include "app/new_plugin.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "app/templates/normalizer.hpp"
#include "app/templates/segmenter.hpp"
#include "app/templates/shared.hpp"
#include "app/templates/sink.hpp"
#include "app/templates/source.hpp"
#include "app/templates/tracker.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

/// Names CMake keeps for targets of its own, and this project's library.
constexpr std::array<std::string_view, 9> kTakenNames = {
    "all", "clean", "edit_cache", "help", "install", "maggic", "package", "rebuild_cache", "test"};

const templates::Plugin& template_of(StageKind kind) {
  switch (kind) {
    case StageKind::kSource: return templates::kSource;
    case StageKind::kNormalizer: return templates::kNormalizer;
    case StageKind::kSegmenter: return templates::kSegmenter;
    case StageKind::kTracker: return templates::kTracker;
    case StageKind::kSink: return templates::kSink;
  }
  throw std::invalid_argument(fmt::format("there is no kind {}", static_cast<int>(kind)));
}

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

void check_name(std::string_view name) {
  const auto is_allowed = [](char c) { return is_lower(c) || is_digit(c) || c == '_'; };
  if (name.empty() || !is_lower(name.front()) || name.back() == '_' ||
      !std::ranges::all_of(name, is_allowed) || name.find("__") != name.npos) {
    throw std::invalid_argument(
        fmt::format("'{}' cannot be a plugin's name, expected lower-case words joined by _, such "
                    "as warm_light",
                    name));
  }
  if (std::ranges::find(kTakenNames, name) != kTakenNames.end()) {
    throw std::invalid_argument(
        fmt::format("'{}' cannot be a plugin's name: the build uses it already", name));
  }
}

/// warm_light → WarmLight
std::string class_name(std::string_view name) {
  std::string result;
  bool at_start = true;
  for (const char c : name) {
    if (c != '_') result += at_start && is_lower(c) ? static_cast<char>(c - 'a' + 'A') : c;
    at_start = c == '_';
  }
  return result;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

void write_file(const fs::path& file, std::string_view text, StageKind kind,
                std::string_view name) {
  std::string filled(text.substr(1));  // a template begins on the line after its delimiter
  replace_all(filled, "@NAME@", name);
  replace_all(filled, "@CLASS@", class_name(name));
  replace_all(filled, "@KIND@", name_of(kind));
  std::ofstream stream(file, std::ios::binary);
  stream << filled;
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

/// A folder that is removed again unless it was renamed away.
class DraftFolder {
 public:
  DraftFolder(const fs::path& folder, std::string_view name)
      : path_(folder / fmt::format(".{}.{}", name, ::getpid())) {
    fs::create_directories(path_);
  }
  ~DraftFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  DraftFolder(const DraftFolder&) = delete;
  DraftFolder& operator=(const DraftFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void new_plugin(StageKind kind, std::string_view name, const fs::path& folder) {
  const templates::Plugin& plugin = template_of(kind);
  check_name(name);
  const fs::path target = folder / name;
  // symlink_status: a link to nothing is in the way as well.
  if (fs::exists(fs::symlink_status(target))) {
    throw std::runtime_error(fmt::format("{} exists already", target.string()));
  }
  const DraftFolder draft(folder, name);
  const auto write = [&](std::string_view file, std::string_view text) {
    write_file(draft.path() / file, text, kind, name);
  };
  write(fmt::format("{}.cpp", name), plugin.source);
  write(fmt::format("{}_test.cpp", name), plugin.test);
  write("CMakeLists.txt", templates::kCMakeLists);
  write("README.md", templates::kReadme);
  fs::rename(draft.path(), target);
}

}  // namespace maggic::app
