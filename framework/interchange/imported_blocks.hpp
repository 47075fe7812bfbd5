#pragma once
/// One block of a calibration file for each kind of foreign calibration.

#include <optional>
#include <string>
#include <vector>

#include "maggic/foreign_calibration.hpp"

namespace maggic {

struct ImportedBlock {
  std::string yaml;  ///< Lines, indented as the block stands in the file.
  std::string found;
  std::vector<std::string> notes;
};

/// The parameters of `hue_pivots`.
ImportedBlock import_pivots(const MaggicSession& session);
/// The parameters of `yuv_boxes`. @throws ConfigError when NoCOL's box cuts a hole into another.
ImportedBlock import_boxes(const YuvBoxFile& file);
/// Entries of `field:`. @throws ConfigError when the points make no field.
ImportedBlock import_corners(const FieldLimits& limits, std::optional<cv::Size> image_size_px);

/// "file.txt:4", safe within a comment.
std::string source_text(const Place& place);
/// `code`, then a comment in a column of its own where it fits.
std::string commented_line(std::string_view code, std::string_view comment);

}  // namespace maggic
