#pragma once
/// The field as the camera sees it: pixels to millimetres and back.
///
/// Pixels are never warped; only points are. A point goes through: lens undistortion →
/// homography of the floor (from the four field corners) → parallax correction for the height of
/// the object → half-time turn.

#include <optional>
#include <vector>

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

#include "maggic/parameters.hpp"
#include "maggic/radial_lens.hpp"

namespace maggic {

/// The league's field sizes: 1500 × 1300 mm and 2200 × 1800 mm.
enum class FieldFormat { k3v3, k5v5 };

/// What is known of the field and the camera: the `field:` section of a pipeline.
struct FieldParameters {
  /// In a file `format` sets both lengths; lengths written beside it have the last word.
  FieldFormat format = FieldFormat::k3v3;
  double length_mm = 1500.0;  ///< Along x, goals left out.
  double width_mm = 1300.0;   ///< Along y.

  /// Top-left, top-right, bottom-right, bottom-left corner of the length × width rectangle in the
  /// picture, pixels. Empty: the rectangle is fitted, centred, into the whole picture; see
  /// `fitted_corners_px`.
  std::vector<cv::Point2d> corners_px;
  /// Width and height of the picture the corners were taken in; corners and lens scale with the
  /// frame when it has another size. Zero: every frame's own size.
  cv::Size image_size_px{0, 0};

  /// Brown–Conrady radial terms k1, k2 in OpenCV's convention, with the focal length in pixels and
  /// the principal point (empty: the picture's centre; focal length empty: the picture's width).
  double lens_k1 = 0.0;
  double lens_k2 = 0.0;
  std::optional<double> focal_length_px;
  std::optional<cv::Point2d> principal_point_px;

  double camera_height_mm = 2000.0;       ///< Of the lens above the floor.
  /// Point of the floor below the lens, in the field frame before the half-time turn: what was
  /// measured once stays right when sides change.
  cv::Point2d camera_position_mm{0, 0};
  double robot_height_mm = 75.0;          ///< Of the tags above the floor.
  double ball_height_mm = 21.35;          ///< Of the ball's centre above the floor.
  bool half_time = false;                 ///< Turn the field frame by 180°: sides were changed.

  void describe(Parameters& parameters);
};

/// Corners, in the order of `FieldParameters::corners_px`, of the length × width rectangle with
/// sides parallel to the picture's, centred, and as large as a border of `margin_px` on every side
/// allows: scale = min((width − 2·margin) / length, (height − 2·margin) / width) pixels a mm around
/// ((width − 1) / 2, (height − 1) / 2).
/// @param margin_px less than half the picture's smaller side.
std::vector<cv::Point2d> fitted_corners_px(const FieldParameters& parameters, cv::Size picture_px,
                                           double margin_px = 0.0);

/// The transform for frames of one size. Immutable; cheap to copy.
class Field {
 public:
  /// @param frame_size_px at least 1×1.
  /// @throws std::invalid_argument when corners are given but not four, not convex, or not in the
  ///   order stated, or when an object is as high as the camera.
  Field(const FieldParameters& parameters, cv::Size frame_size_px);

  /// Field position of what is seen at `point_px` if it is `height_mm` above the floor. Finite for
  /// every finite pixel: beyond the horizon or the lens's reach it is only far away.
  cv::Point2d to_field_mm(cv::Point2d point_px, double height_mm) const;
  /// Where in the picture a point of the field, `height_mm` above the floor, is seen. Inverse of
  /// `to_field_mm` to 1e-6 px inside the picture.
  cv::Point2d to_image_px(cv::Point2d position_mm, double height_mm) const;

  /// Derivative of `to_field_mm` at a point: maps small pixel offsets to millimetres.
  cv::Matx22d jacobian_mm_per_px(cv::Point2d point_px, double height_mm) const;
  /// |det| of the Jacobian: how many mm² of the field one pixel covers.
  double mm2_per_px2(cv::Point2d point_px, double height_mm) const;

  const FieldParameters& parameters() const { return parameters_; }
  cv::Size frame_size_px() const { return frame_size_px_; }
  double robot_height_mm() const { return parameters_.robot_height_mm; }
  double ball_height_mm() const { return parameters_.ball_height_mm; }

 private:
  cv::Point2d undistort(cv::Point2d point_px) const;
  cv::Point2d distort(cv::Point2d ray) const;
  double parallax_factor(double height_mm) const;

  FieldParameters parameters_;
  cv::Size frame_size_px_;
  cv::Point2d reference_per_frame_;  ///< Size of the reference picture over the frame's.
  cv::Point2d principal_px_;         ///< In the reference picture, as is the focal length.
  double focal_px_ = 1.0;
  RadialLens lens_;
  cv::Matx33d floor_from_ray_;  ///< Undistorted rays, in focal lengths, to mm of the floor.
  cv::Matx33d ray_from_floor_;
};

}  // namespace maggic
