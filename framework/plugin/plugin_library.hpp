#pragma once
/// A plugin's shared library while it is open.

#include <filesystem>
#include <vector>  // boost/dll of 1.74 forgets it under BOOST_DLL_USE_STD_FS

#include <boost/dll/shared_library.hpp>

#include "maggic/plugin_registry.hpp"

namespace maggic {

struct PluginDescriptor;

/// Immutable once open; closes the library when the last owner lets go.
class PluginLibrary {
 public:
  /// Checks `file` and opens it; nothing of it runs before its ABI is known to be ours.
  /// @throws std::runtime_error with the reason alone, the file's name left out.
  explicit PluginLibrary(const std::filesystem::path& file);

  const PluginInfo& info() const { return info_; }

  /// A fresh stage, to be given back to `destroy`.
  /// @throws PluginError when its constructor throws.
  Stage* create() const;
  void destroy(Stage* stage) const noexcept;

 private:
  void check_descriptor() const;

  boost::dll::shared_library library_;
  const PluginDescriptor* descriptor_ = nullptr;  ///< Lies in the library.
  PluginInfo info_;
};

}  // namespace maggic
