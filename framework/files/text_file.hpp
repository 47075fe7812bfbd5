#pragma once
/// Reading files a person named on the command line.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace maggic {

/// The bytes of a regular file.
/// @param max_bytes how long it may be.
/// @param expected what it should be, for messages: "YAML file".
/// @throws ConfigError when there is no such file, it is a folder, a pipe or a device, too long,
///   or cannot be read.
std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes,
                           std::string_view expected);

}  // namespace maggic
