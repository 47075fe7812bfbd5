#include "maggic/plugin_registry.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/dll/runtime_symbol_info.hpp>

#include "plugin/plugin_library.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".so";

/// Plugin files by name. A folder that is listed twice, also through a link, counts once.
using FilesByName = std::map<std::string, std::vector<fs::path>, std::less<>>;

FilesByName plugin_files(const std::vector<fs::path>& folders) {
  FilesByName files;
  std::set<fs::path> seen;
  for (const fs::path& folder : folders) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error || !seen.insert(real).second) continue;
    // The error_code forms: a folder that vanishes or may not be read is as good as missing.
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::path& file = entry->path();
      if (file.extension() == kSuffix) files[file.stem().string()].push_back(file);
    }
  }
  return files;
}

std::string joined(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.string());
  return fmt::format("{}", fmt::join(names, " and "));
}

std::string names_in(const FilesByName& files) {
  std::vector<std::string_view> names;
  for (const auto& [name, paths] : files) names.push_back(name);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void StageDeleter::operator()(Stage* stage) const noexcept {
  if (library != nullptr) {
    library->destroy(stage);
  } else {
    delete stage;
  }
}

PluginRegistry::PluginRegistry(std::vector<fs::path> folders) : folders_(std::move(folders)) {}

std::vector<fs::path> PluginRegistry::default_folders() {
  std::vector<fs::path> folders;
  if (const char* const path = std::getenv("MAGGIC_PLUGIN_PATH")) {
    std::string_view rest = path;
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find(':'), rest.size());
      if (length > 0) folders.emplace_back(rest.substr(0, length));
      rest.remove_prefix(std::min(length + 1, rest.size()));
    }
  }
  std::error_code error;
  const fs::path program = boost::dll::program_location(error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "lib/maggic/plugins");
  return folders;
}

void PluginRegistry::add_folder(fs::path folder) { folders_.push_back(std::move(folder)); }

std::shared_ptr<const PluginLibrary> PluginRegistry::load(const fs::path& file) {
  try {
    return std::make_shared<const PluginLibrary>(file);
  } catch (const std::exception& error) {
    throw PluginError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::shared_ptr<const PluginLibrary> PluginRegistry::find(std::string_view name) {
  if (const auto known = loaded_.find(name); known != loaded_.end()) return known->second;
  const FilesByName files = plugin_files(folders_);
  const auto found = files.find(name);
  if (found == files.end()) {
    std::vector<std::string> searched;
    for (const fs::path& folder : folders_) searched.push_back(folder.string());
    throw PluginError(fmt::format("there is no plugin '{}' (known: {}; searched: {})", name,
                                  names_in(files), fmt::join(searched, ", ")));
  }
  if (found->second.size() > 1) {
    throw PluginError(fmt::format("plugin '{}' is there more than once: {}; expected one of them",
                                  name, joined(found->second)));
  }
  return loaded_.emplace(found->first, load(found->second.front())).first->second;
}

StagePtr<Stage> PluginRegistry::create(StageKind kind, std::string_view name) {
  std::shared_ptr<const PluginLibrary> library = find(name);
  const PluginInfo& info = library->info();
  if (info.kind != kind) {
    throw PluginError(fmt::format("plugin '{}' ({}) is a {}, expected a {}", name,
                                  info.file.string(), name_of(info.kind), name_of(kind)));
  }
  Stage* const stage = library->create();
  return StagePtr<Stage>(stage, StageDeleter{std::move(library)});
}

PluginInfo PluginRegistry::info(std::string_view name) { return find(name)->info(); }

PluginRegistry::Scan PluginRegistry::scan() {
  Scan result;
  for (const auto& [name, files] : plugin_files(folders_)) {
    if (files.size() > 1) {
      for (const fs::path& file : files) {
        result.refused.push_back(
            {file, fmt::format("there is more than one plugin '{}': {}", name, joined(files))});
      }
      continue;
    }
    try {
      if (!loaded_.contains(name)) {
        loaded_.emplace(name, std::make_shared<const PluginLibrary>(files.front()));
      }
      result.plugins.push_back(loaded_.find(name)->second->info());
    } catch (const std::exception& error) {
      result.refused.push_back({files.front(), error.what()});
    }
  }
  std::ranges::sort(result.plugins, {}, [](const PluginInfo& plugin) {
    return std::tuple(plugin.kind, std::string_view(plugin.name));
  });
  return result;
}

}  // namespace maggic
