#pragma once
/// The field as the camera sees it: pixels to millimetres and back.
///
/// Pixels are never warped; only points are. A point goes through: lens undistortion →
/// homography of the floor (from the four field corners) → parallax correction for the height of
/// the object → half-time turn.

#include <array>
#include <optional>

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

#include "maggic/parameters.hpp"

namespace maggic {

/// What is known of the field and the camera: the `field:` section of a pipeline.
struct FieldParameters {
  double length_mm = 1500.0;  ///< Along x, goals left out (3v3: 1500, 5v5: 2200).
  double width_mm = 1300.0;   ///< Along y (3v3: 1300, 5v5: 1800).

  /// Top-left, top-right, bottom-right, bottom-left corner of the length × width rectangle in the
  /// picture, pixels. Empty: the rectangle is fitted, centred, into the whole picture.
  std::vector<cv::Point2d> corners_px;
  /// Width and height of the picture the corners were taken in; corners and lens scale with the
  /// frame when it has another size. Zero: taken from the first frame.
  cv::Size image_size_px{0, 0};

  /// Brown–Conrady radial terms k1, k2 in OpenCV's convention, with the focal length in pixels and
  /// the principal point (empty: the picture's centre; focal length empty: the picture's width).
  double lens_k1 = 0.0;
  double lens_k2 = 0.0;
  std::optional<double> focal_length_px;
  std::optional<cv::Point2d> principal_point_px;

  double camera_height_mm = 2000.0;       ///< Of the lens above the floor.
  cv::Point2d camera_position_mm{0, 0};   ///< Point of the floor below the lens, field frame.
  double robot_height_mm = 75.0;          ///< Of the tags above the floor.
  double ball_height_mm = 21.35;          ///< Of the ball's centre above the floor.
  bool half_time = false;                 ///< Turn the field frame by 180°: sides were changed.

  void describe(Parameters& parameters);
};

/// The transform for frames of one size. Immutable; cheap to copy.
class Field {
 public:
  /// @param frame_size_px at least 1×1.
  /// @throws std::invalid_argument when corners are given but not four, not convex, or not in the
  ///   order stated.
  Field(const FieldParameters& parameters, cv::Size frame_size_px);

  /// Field position of what is seen at `point_px` if it is `height_mm` above the floor.
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
  cv::Point2d distort(cv::Point2d point_px) const;

  FieldParameters parameters_;
  cv::Size frame_size_px_;
  cv::Point2d principal_px_;
  double focal_px_ = 1.0;
  cv::Matx33d floor_from_image_;
  cv::Matx33d image_from_floor_;
};

}  // namespace maggic
