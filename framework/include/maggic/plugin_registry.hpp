#pragma once
/// Finds plugin libraries, checks them, and makes stages from them.

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "maggic/stage.hpp"
#include "maggic/stage_kind_of.hpp"

namespace maggic {

/// A plugin could not be found, loaded or created; `what()` names the file and the reason.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class PluginLibrary;  // an open, checked library

/// Destroys a stage in the library that made it, and only then lets go of the library.
struct StageDeleter {
  /// Shared by every stage the library made; null for a stage made by `new` in this program.
  std::shared_ptr<const PluginLibrary> library;
  void operator()(Stage* stage) const noexcept;
};

template <class T>
using StagePtr = std::unique_ptr<T, StageDeleter>;

/// What is known of a plugin that loaded well.
struct PluginInfo {
  std::string name;
  StageKind kind = StageKind::kSource;
  std::string summary;
  std::filesystem::path file;
};

/// A file that looks like a plugin and is none, and why.
struct PluginRefusal {
  std::filesystem::path file;
  std::string reason;
};

/// Loads `<folder>/<name>.so` on demand; a library that is not asked for is never opened, so a
/// run pays only for the plugins it uses. Nothing is unloaded while the registry or a stage lives.
/// Not thread-safe.
class PluginRegistry {
 public:
  /// @param folders searched in order; missing folders are passed over.
  explicit PluginRegistry(std::vector<std::filesystem::path> folders = default_folders());

  /// `$MAGGIC_PLUGIN_PATH` (colon-separated), then `../lib/maggic/plugins` beside the running
  /// program, which serves the build tree and an installation alike.
  static std::vector<std::filesystem::path> default_folders();

  /// Adds a folder, searched after the others.
  void add_folder(std::filesystem::path folder);

  /// A fresh stage of plugin `name`, constructed only.
  /// @throws PluginError when there is no such plugin (the message lists the known names), when
  ///   two folders hold one of that name, when its file is refused, when it is of another kind,
  ///   or when its constructor throws.
  StagePtr<Stage> create(StageKind kind, std::string_view name);

  template <StageInterface T>
  StagePtr<T> create(std::string_view name) {
    StagePtr<Stage> stage = create(kStageKindOf<T>, name);
    StageDeleter deleter = stage.get_deleter();
    return StagePtr<T>(static_cast<T*>(stage.release()), std::move(deleter));
  }

  /// Loads `name` if need be and tells what it is. @throws PluginError as `create` does.
  PluginInfo info(std::string_view name);

  /// Everything found in the folders: plugins sorted by kind then name, and refused files. Opens
  /// every library.
  struct Scan {
    std::vector<PluginInfo> plugins;
    std::vector<PluginRefusal> refused;
  };
  Scan scan();

  /// Checks one file and opens it. @throws PluginError naming the file and the reason.
  static std::shared_ptr<const PluginLibrary> load(const std::filesystem::path& file);

 private:
  std::shared_ptr<const PluginLibrary> find(std::string_view name);

  std::vector<std::filesystem::path> folders_;
  std::map<std::string, std::shared_ptr<const PluginLibrary>, std::less<>> loaded_;
};

}  // namespace maggic
