#include "files/text_file.hpp"

#include <fstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "maggic/config_error.hpp"

namespace maggic {

std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes,
                           std::string_view expected) {
  const auto refuse = [&](std::string message) {
    throw ConfigError({{file.string(), 0, 0, std::move(message)}});
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    refuse(fmt::format("found no such file, expected a {}", expected));
  }
  if (error) refuse(fmt::format("cannot be read: {}", error.message()));
  if (std::filesystem::is_directory(status)) {
    refuse(fmt::format("found a directory, expected a {}", expected));
  }
  // A pipe or a device might never end.
  if (!std::filesystem::is_regular_file(status)) {
    refuse(fmt::format("found something that is no regular file, expected a {}", expected));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    refuse(fmt::format("cannot be opened for reading, expected a readable {}", expected));
  }
  // One byte more than allowed tells a file that is too long, whatever its size claims to be.
  std::string text(max_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse("cannot be read to its end");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > max_bytes) {
    refuse(fmt::format("found more than {} bytes, expected at most {}", max_bytes, max_bytes));
  }
  return text;
}

}  // namespace maggic
