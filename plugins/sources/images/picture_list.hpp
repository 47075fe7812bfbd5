#pragma once
/// Which files a path, folder or pattern stands for.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace maggic::images {

struct PictureList {
  std::vector<std::filesystem::path> files;  ///< In natural order.
  /// Of a folder: files passed over because they are not named like pictures.
  std::vector<std::filesystem::path> passed_over;
};

/// @param path a file, whatever its name; a folder, whose files named like pictures count (hidden
///   ones and subfolders do not); or a pattern with `*` and `?` in any of its parts, whose matches
///   count whatever their names. What exists under that very name is not taken for a pattern.
/// @throws std::runtime_error when nothing is there.
PictureList list_pictures(const std::string& path);

}  // namespace maggic::images
