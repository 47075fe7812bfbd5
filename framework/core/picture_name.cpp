#include "maggic/picture_name.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace maggic {

bool has_picture_extension(const std::filesystem::path& file) {
  using namespace std::string_view_literals;
  constexpr std::array kExtensions = {".bmp"sv, ".dib"sv,  ".exr"sv,  ".hdr"sv, ".jp2"sv,
                                      ".jpe"sv, ".jpeg"sv, ".jpg"sv,  ".pbm"sv, ".pgm"sv,
                                      ".pic"sv, ".png"sv,  ".pnm"sv,  ".ppm"sv, ".ras"sv,
                                      ".sr"sv,  ".tif"sv,  ".tiff"sv, ".webp"sv};
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

}  // namespace maggic
