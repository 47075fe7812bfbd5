#pragma once
/// Writing files so that what was there is lost only once the new content is whole.

#include <filesystem>
#include <string_view>

namespace maggic {

/// Replaces `file` by `content`: written beside it, brought to disk, then renamed over it. A crash
/// or a full disk leaves the old file as it was. A symbolic link is followed: what it leads to is
/// replaced.
/// @throws std::runtime_error naming the file and the reason.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

}  // namespace maggic
