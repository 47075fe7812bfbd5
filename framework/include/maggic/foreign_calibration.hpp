#pragma once
/// Calibrations of other programs, read into one of ours.
///
/// Known are the files of RoboCIn's vss-vision, each recognised by its content:
///
///   MaggicSegmentation.txt   the word `Maggic`, two ends of a range, the gray threshold, then a
///                            line `hue label` for every pivot
///   YUV boxes (XML)          `<opencv_storage>` with YMIN … VMAX for every colour, and `GrayScale`
///   fieldLimits.json         `point1` … `point4`: the corners of the 1700 × 1300 mm outline, goals
///                            included, from the top left one counter-clockwise
///
/// What those programs do with their numbers: docs/import.md.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/document.hpp"

namespace maggic {

/// A whole number and where it stood.
struct PlacedNumber {
  int value = 0;
  Place place;
};

/// MaggicSegmentation.txt.
struct MaggicSession {
  struct Pivot {
    PlacedNumber hue;    ///< -1 … 255, OpenCV's full circle; -1 acts as 255.
    PlacedNumber label;  ///< 1 … 9, in the order of Palette::standard().
  };
  Place place;
  PlacedNumber gray_threshold;  ///< 0 … 255.
  std::vector<Pivot> pivots;    ///< In file order, at least one.
};

/// The XML file of the legacy method.
struct YuvBoxFile {
  struct Box {
    std::string name;  ///< As the file has it: "NoCOL", "Orange", "LightBlue", …
    Place place;
    std::array<int, 3> min{};  ///< Y, U, V, each 0 … 255, included.
    std::array<int, 3> max{};
  };
  Place place;
  std::vector<Box> boxes;  ///< In file order, names unique.
  std::optional<PlacedNumber> gray_scale;
};

/// fieldLimits.json.
struct FieldLimits {
  Place place;
  std::array<cv::Point2d, 4> points_px;  ///< Top left, bottom left, bottom right, top right.
};

using ForeignCalibration = std::variant<MaggicSession, YuvBoxFile, FieldLimits>;

/// @param file_name as shown in messages and comments.
/// @throws ConfigError with the mistakes found: place, what was found, what was expected.
ForeignCalibration parse_foreign_calibration(std::string_view text, std::string_view file_name);

/// Reads a file. @throws ConfigError also when it cannot be read or is longer than 1 MiB.
ForeignCalibration load_foreign_calibration(const std::filesystem::path& file);

/// A calibration file of ours.
struct ImportedCalibration {
  std::string yaml;                ///< A comment on every number says where it came from.
  std::vector<std::string> found;  ///< "7 pivots for hue_pivots", …
  std::vector<std::string> notes;  ///< What could not be taken over, and what follows from that.
};

/// Merges calibrations of different kinds.
/// @param image_size_px of the picture field corners were taken in, where known.
/// @throws ConfigError when two are of one kind, or when one says what ours cannot.
ImportedCalibration import_calibrations(std::span<const ForeignCalibration> calibrations,
                                        std::optional<cv::Size> image_size_px);

}  // namespace maggic
