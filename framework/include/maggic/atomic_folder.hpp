#pragma once
/// Folders that appear as a whole or not at all.

#include <filesystem>
#include <functional>
#include <string_view>

namespace maggic {

/// A folder that is filled beside its place and moved there once it is complete. Removed again if
/// it never was; a crash leaves what was there before.
class AtomicFolder {
 public:
  /// @param target where the folder goes; its parent must exist. A folder that is there already is
  ///   replaced if each of its entries is one that `is_ours` (by name) says may go.
  /// @throws std::runtime_error naming the folder and the reason, before anything is written.
  AtomicFolder(std::filesystem::path target,
               const std::function<bool(std::string_view name)>& is_ours);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to put the files meanwhile.
  const std::filesystem::path& path() const { return path_; }

  /// Moves the folder to its place. Call once. @throws std::runtime_error when that fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
};

}  // namespace maggic
