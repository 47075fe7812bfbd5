#include "picture_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <fstream>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

namespace maggic::images {
namespace {

namespace fs = std::filesystem;

// No camera's picture comes near; a film or a disk image called .png should not fill the memory.
constexpr std::uintmax_t kMostBytes = 256u << 20;

/// True for a JPEG file without its end marker. OpenCV decodes such a file without a complaint and
/// leaves the missing part gray.
bool is_cut_off_jpeg(std::span<const unsigned char> bytes) {
  constexpr unsigned char kStartOfScan = 0xDA;
  constexpr std::array<unsigned char, 2> kEndOfImage = {0xFF, 0xD9};
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8 || bytes[2] != 0xFF) return false;
  // Segments are skipped as wholes: EXIF's thumbnail is a JPEG with an end marker of its own.
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xFF && bytes[at + 1] != kStartOfScan) {
    const bool is_fill_byte = bytes[at + 1] == 0xFF;
    at += is_fill_byte ? 1 : 2u + (bytes[at + 2] << 8 | bytes[at + 3]);
  }
  const auto rest = bytes.subspan(std::min(at, bytes.size()));
  // Not std::ranges::search, which clang 14 cannot compile.
  return std::search(rest.begin(), rest.end(), kEndOfImage.begin(), kEndOfImage.end()) ==
         rest.end();
}

}  // namespace

std::optional<std::string> PictureReader::read_bytes(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return failed ? failed.message() : "it is not a file";
  const std::uintmax_t size = fs::file_size(file, failed);
  if (failed) return failed.message();
  if (size == 0) return "it is empty";
  if (size > kMostBytes) {
    return fmt::format("it has {} MB, more than a picture of {} MB", size >> 20, kMostBytes >> 20);
  }
  bytes_.resize(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(size));
  if (!stream) return "it cannot be read to its end (permission? disk?)";
  return std::nullopt;
}

std::optional<std::string> PictureReader::read(const fs::path& file, cv::Mat& picture) {
  if (auto refusal = read_bytes(file)) return refusal;
  if (is_cut_off_jpeg(bytes_)) return "it is a JPEG that ends too early";
  // ANYCOLOR drops alpha, which the host would do otherwise; UNCHANGED is the one flag that keeps
  // OpenCV from turning the picture.
  const int flags = turn_by_exif_ ? cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH
                                  : static_cast<int>(cv::IMREAD_UNCHANGED);
  try {
    // Not imdecode's third parameter: it would leave an earlier picture there when this is none.
    picture = cv::imdecode(bytes_, flags);
    if (picture.empty()) return "OpenCV finds no whole picture in it";
  } catch (const std::exception& e) {  // too many pixels, a size that does not fit into memory
    return fmt::format("OpenCV refuses it ({})", e.what());
  }
  return std::nullopt;
}

}  // namespace maggic::images
