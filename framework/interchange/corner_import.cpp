/// fieldLimits.json as entries of a field section.

#include <array>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "config/wording.hpp"
#include "field/corners.hpp"
#include "interchange/imported_blocks.hpp"

namespace maggic {
namespace {

// What the four points are the corners of: the 3v3 field and a goal's depth at either end.
constexpr double kOutlineLengthMm = 1700.0;
constexpr double kFieldLengthMm = 1500.0;

/// Corners of the field in the picture, top left first, clockwise, as the outline's are given.
std::vector<cv::Point2d> field_corners_px(const std::vector<cv::Point2d>& outline_px) {
  const auto rectangle = [](double length) {
    // Sides are of length 1 across: only places along them matter.
    const auto half = static_cast<float>(length / kOutlineLengthMm);
    return std::vector<cv::Point2f>{{-half, -1}, {half, -1}, {half, 1}, {-half, 1}};
  };
  const std::vector<cv::Point2f> outline = rectangle(kOutlineLengthMm);
  const std::vector<cv::Point2f> seen(outline_px.begin(), outline_px.end());
  const cv::Matx33d to_px(cv::getPerspectiveTransform(outline, seen));
  std::vector<cv::Point2d> corners_px;
  for (const cv::Point2f& corner : rectangle(kFieldLengthMm)) {
    const cv::Vec3d seen_at = to_px * cv::Vec3d(corner.x, corner.y, 1.0);
    corners_px.emplace_back(seen_at[0] / seen_at[2], seen_at[1] / seen_at[2]);
  }
  return corners_px;
}

}  // namespace

ImportedBlock import_corners(const FieldLimits& limits, std::optional<cv::Size> image_size_px) {
  const auto& points = limits.points_px;
  const std::vector<cv::Point2d> outline_px{points[0], points[3], points[2], points[1]};
  if (const std::string mistake = mistake_in_corners(outline_px); !mistake.empty()) {
    throw ConfigError({mistake_at(
        limits.place, fmt::format("point1, point4, point3, point2 make no field: {}", mistake))});
  }
  const std::vector<cv::Point2d> corners_px = field_corners_px(outline_px);
  const std::string source = source_text({limits.place.file, 0, 0});

  ImportedBlock block;
  block.yaml += commented_line("  format: 3v3", "the field of " + source);
  block.yaml += fmt::format(
      "  # Top-left, top-right, bottom-right, bottom-left of the 1500 × 1300 mm field, from the "
      "four\n"
      "  # points of {}: those are the corners of 1700 × 1300 mm, goals included.\n",
      source);
  block.yaml += "  corners_px:\n";
  for (const cv::Point2d& corner : corners_px) {
    block.yaml += fmt::format("    - [{:.2f}, {:.2f}]\n", corner.x, corner.y);
  }
  if (image_size_px) {
    block.yaml += commented_line(
        fmt::format("  image_size_px: [{}, {}]", image_size_px->width, image_size_px->height),
        "the picture they were taken in: --image-size");
  } else {
    block.yaml += "  # image_size_px: [640, 480]   # the picture they were taken in, which " +
                  source + " does not say\n";
    block.notes.push_back(fmt::format(
        "{} does not say in which picture size its points were taken: they hold for frames of that "
        "size alone; --image-size WxH makes them hold for others",
        source));
  }
  block.found = "four corners for field";
  return block;
}

}  // namespace maggic
