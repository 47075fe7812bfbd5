#pragma once
/// Robots' tags as calibration meets them: drawn into pictures, or as patches found already.

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "calibration/chroma_frame.hpp"
#include "calibration/pattern_candidates.hpp"
#include "maggic/palette.hpp"
#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic::calibration::tags {

inline Label label(std::string_view name) { return Palette::standard().find(name).value(); }

/// Where a robot stands in the picture.
struct Pose {
  cv::Point2d center_px;
  double heading_deg = 0.0;  ///< Counter-clockwise as seen, y up.
  cv::Point2d px_per_mm{0.4, 0.4};

  cv::Point2d to_px(cv::Point2d robot_mm) const {
    const double angle = heading_deg * std::numbers::pi / 180.0;
    const cv::Point2d turned(std::cos(angle) * robot_mm.x - std::sin(angle) * robot_mm.y,
                             std::sin(angle) * robot_mm.x + std::cos(angle) * robot_mm.y);
    return {center_px.x + px_per_mm.x * turned.x, center_px.y - px_per_mm.y * turned.y};
  }
};

/// A round patch as the finder would give it, without pixels.
inline Patch patch_at(cv::Point2d centroid_px, double area_px, double hue, int spread = 150) {
  Patch patch;
  patch.centroid_px = centroid_px;
  patch.area_px = area_px;
  const double variance = area_px / (4.0 * std::numbers::pi);
  patch.moments_px2 = {variance, 0.0, 0.0, variance};
  patch.hue = hue;
  patch.median_spread = spread;
  return patch;
}

/// Adds a robot's patches, in the layout's order.
/// @param hues of the patches.
inline void add_robot(const TagLayout& layout, const Pose& pose, std::span<const double> hues,
                      std::vector<Patch>& patches) {
  for (std::size_t i = 0; i < layout.patches.size(); ++i) {
    const TagPatch& tag = layout.patches[i];
    patches.push_back(patch_at(pose.to_px(tag.center_mm),
                               tag.expected_area_mm2() * pose.px_per_mm.x * pose.px_per_mm.y,
                               hues[i]));
  }
}

/// A colour of full strength with this hue, as OpenCV's HSV_FULL has it.
inline cv::Scalar color_of_hue(int hue) {
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(1, 1, CV_8UC3, cv::Scalar(hue, 255, 220)), bgr, cv::COLOR_HSV2BGR_FULL);
  const auto color = bgr.at<cv::Vec3b>(0, 0);
  return {static_cast<double>(color[0]), static_cast<double>(color[1]),
          static_cast<double>(color[2])};
}

/// As calibration looks at a picture, colours taken as they are.
inline ChromaFrame look_at(const cv::Mat& bgr) {
  fakes::SameNormalizer normalizer;
  return make_chroma_frame(bgr, normalizer);
}

}  // namespace maggic::calibration::tags
