#include "calibration/calibration_file.hpp"

#include <string_view>

#include <fmt/format.h>

namespace maggic::calibration {
namespace {

std::string indented(std::string_view yaml, std::string_view indent) {
  std::string text;
  while (!yaml.empty()) {
    const std::size_t end = yaml.find('\n');
    text += fmt::format("{}{}\n", indent, yaml.substr(0, end));
    yaml = end == std::string_view::npos ? std::string_view{} : yaml.substr(end + 1);
  }
  return text;
}

std::string corner(cv::Point2d p) { return fmt::format("[{:.1f}, {:.1f}]", p.x, p.y); }

}  // namespace

std::string to_calibration_yaml(const CalibrationNumbers& numbers) {
  std::string yaml;
  for (const std::string& line : numbers.heading) yaml += fmt::format("# {}\n", line);
  yaml += fmt::format("\nsegmenter:\n  {}:\n{}", numbers.segmenter,
                      indented(numbers.segmenter_yaml, "    "));
  if (numbers.field) {
    const FieldNumbers& field = *numbers.field;
    const auto& c = field.corners_px;
    yaml += fmt::format(
        "\nfield:\n  # Corners: top left, top right, bottom right, bottom left. {}\n"
        "  corners_px: [{}, {}, {}, {}]\n"
        "  image_size_px: [{}, {}]   # the picture they were taken in\n",
        field.corners_comment, corner(c[0]), corner(c[1]), corner(c[2]), corner(c[3]),
        field.image_size_px.width, field.image_size_px.height);
    yaml += fmt::format("  lens:\n    k1: {:.4f}   # {}\n    k2: {:.4f}   # goes with k1\n",
                        field.lens_k1, field.lens_comment, field.lens_k2);
  }
  if (numbers.blobs) {
    const BlobNumbers& blobs = *numbers.blobs;
    yaml +=
        fmt::format("\nblobs:\n  min_area_mm2: {:.0f}   # {}\n  max_area_mm2: {:.0f}   # {}\n",
                    blobs.min_area_mm2, blobs.min_comment, blobs.max_area_mm2, blobs.max_comment);
  }
  if (numbers.light) {
    const auto& [red, green, blue] = numbers.light->reference_rgb;
    yaml += fmt::format(
        "\nlight:\n  follow: {}   # false: take colours as they come, even when lamps change\n"
        "  reference_rgb: [{:.1f}, {:.1f}, {:.1f}]   # the field's colour in the light of these "
        "numbers\n",
        numbers.light->follow, red, green, blue);
  }
  return yaml;
}

}  // namespace maggic::calibration
