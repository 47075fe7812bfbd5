#pragma once
/// The folder of a plugin to start from.

#include <filesystem>
#include <string_view>

#include "maggic/stage.hpp"

namespace maggic::app {

/// Writes `folder/name/` with a working plugin of that kind: its source, its test, a CMakeLists.txt
/// that serves inside this project's tree and, with the installed package, on its own, and a
/// README. `folder` is made if need be. The plugin's folder appears complete or not at all.
/// @param name becomes the plugin's name: lower-case words joined by `_`.
/// @throws std::invalid_argument for a name that cannot be one; std::runtime_error when
///   `folder/name` exists or cannot be written.
void new_plugin(StageKind kind, std::string_view name, const std::filesystem::path& folder);

}  // namespace maggic::app
