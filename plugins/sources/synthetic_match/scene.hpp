#pragma once
/// The picture as an ideal lens would draw it: sharp, evenly lit, without noise.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "coverage.hpp"
#include "label_picture.hpp"
#include "maggic/detections.hpp"
#include "maggic/field.hpp"
#include "maggic/tag_layout.hpp"
#include "match.hpp"

namespace maggic::synthetic_match {

/// Red, green, blue, 0 … 255.
using Rgb = std::array<double, 3>;

/// What a robot wears.
struct RobotOutfit {
  Team team = Team::kBlue;
  TagId id;
  const TagLayout* layout = nullptr;  ///< Never null once set up; borrowed.
  Label team_color = kBackground;
};

/// Something flat on the floor or around the field that is neither tag nor ball.
struct FloorPatch {
  std::vector<cv::Point2d> corners_mm;
  Rgb color{};
};

/// CV_32FC3 (B G R, 0 … 255) picture of field and objects. Redraws only what moved.
class Scene {
 public:
  /// @param colors by label.
  /// @param clutter from the floor upwards; always below robots and ball.
  Scene(const Field& field, std::vector<Rgb> colors, Label ball_color,
        std::span<const FloorPatch> clutter = {});

  /// From now on `draw` keeps `labels` too.
  void keep_labels() { label_picture_.emplace(field_.frame_size_px()); }

  /// Draws the objects in place of the last ones and writes what can be seen of them into `truth`:
  /// centroids and areas in the picture, and the motion they were drawn with. `truth.robots` ends
  /// up in the order of `outfits`.
  void draw(std::span<const RobotMotion> robots, std::span<const RobotOutfit> outfits,
            const BallMotion& ball, Detections& truth);

  const cv::Mat& picture() const { return picture_; }
  /// What covers the centre of every pixel (CV_8UC1): tags and ball; everything else is background.
  /// Only after `keep_labels`.
  const cv::Mat& labels() const { return label_picture_->labels(); }
  /// Where the picture differs from the previous one.
  std::span<const cv::Rect> changed() const { return changed_; }

 private:
  using Contour = std::vector<cv::Point2d>;

  void draw_field();
  void label(std::span<const cv::Point2d> contour_px, Label label);
  void add_polygon(std::span<const cv::Point2d> corners_mm);
  void add_circle(cv::Point2d center_mm, double radius_mm, bool hole);
  void add_band(cv::Point2d from_mm, cv::Point2d to_mm);
  cv::Rect fill(const Rgb& color);
  /// Where the shape lies wholly on `base`, so that shapes sharing an edge leave no seam.
  void fill_on(const Rgb& base, const Rgb& color);

  // Each answers with the box it may have changed.
  cv::Rect draw_body(const RobotMotion& robot);
  cv::Rect draw_top(const RobotMotion& robot, const RobotOutfit& outfit, RobotDetection& truth);
  cv::Rect draw_ball(const BallMotion& ball, BallDetection& truth);

  Field field_;
  std::vector<Rgb> colors_;
  Label ball_color_;
  Coverage coverage_;
  cv::Mat background_;
  cv::Mat picture_;
  std::optional<LabelPicture> label_picture_;
  Contour contour_;
  std::vector<cv::Rect> drawn_;  ///< A box each robot, then the ball's.
  std::vector<cv::Rect> changed_;
};

}  // namespace maggic::synthetic_match
