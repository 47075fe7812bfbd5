#pragma once
/// Reads one picture file at a time.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace maggic::images {

class PictureReader {
 public:
  /// @param turn_by_exif whether EXIF's orientation is applied.
  explicit PictureReader(bool turn_by_exif) : turn_by_exif_(turn_by_exif) {}

  /// Decodes `file` into new memory. Depth and number of channels are the file's own.
  /// @return nothing when that worked, else why not; `picture` is then of no use.
  std::optional<std::string> read(const std::filesystem::path& file, cv::Mat& picture);

 private:
  std::optional<std::string> read_bytes(const std::filesystem::path& file);

  const bool turn_by_exif_;
  std::vector<unsigned char> bytes_;  ///< Of the file, kept for the next.
};

}  // namespace maggic::images
