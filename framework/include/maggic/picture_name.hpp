#pragma once
/// Which files are pictures, judged by their name.

#include <filesystem>

namespace maggic {

/// True when `file` has an extension of a still picture OpenCV may read (png, jpg, tif, …), in
/// upper or lower case. The file itself is not looked at.
bool has_picture_extension(const std::filesystem::path& file);

}  // namespace maggic
