#pragma once
/// Draws what was found over the picture it was found in.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"
#include "maggic/palette.hpp"

namespace maggic {

struct OverlayOptions {
  /// Whole-number enlargement, so that outlines and names stay readable on small pictures. 0:
  /// twice for pictures less than 960 pixels wide, once otherwise.
  int scale = 0;
  bool field_lines = true;  ///< Outline, centre line and axes of the calibrated field.
  bool caption = true;      ///< Strip below the picture: frame, time, ms a step.
  int ball_trail_frames = 24;
};

/// Annotates frames. Remembers the ball's latest places for its trail, hence one instance a
/// stream, frames in order. One thread at a time.
///
/// In the picture: the field's outline with the origin's axes (x red, y green); tag patches
/// outlined in their palette colour; robots with team letter and id ("B0", "Y?" when the id is
/// unknown) and an arrow to the front; the ball circled, with trail and speed. What is predicted
/// rather than seen is dashed. Every stroke has a dark rim, so it shows on any background.
class Overlay {
 public:
  explicit Overlay(const Palette& palette, OverlayOptions options = {});

  /// The size of the annotated picture for frames of `frame_size_px`: even on both sides, as
  /// video codecs want it.
  cv::Size size_for(cv::Size frame_size_px) const;

  /// Draws `result` into `out`, which becomes CV_8UC3 of `size_for` the frame's size; its memory
  /// is reused when it fits. The frame itself is not touched.
  /// @param field maps this frame's pixels.
  void draw(const FrameResult& result, const Field& field, cv::Mat& out);

 private:
  int scale_for(cv::Size frame_size_px) const;
  /// Frame pixels to canvas pixels, at the sub-pixel resolution drawing uses.
  cv::Point canvas(cv::Point2d point_px) const;
  void polyline(cv::Mat& out, const std::vector<cv::Point2d>& points_px, bool closed,
                cv::Scalar color, int thickness);
  void dashed_circle(cv::Mat& out, cv::Point2d center_px, double radius_px, cv::Scalar color,
                     int thickness);
  void text(cv::Mat& out, const std::string& what, cv::Point2d canvas_px, double size,
            cv::Scalar color);

  void draw_field(cv::Mat& out, const Field& field);
  void draw_patch(cv::Mat& out, const TagSighting& tag, const std::vector<Blob>& blobs);
  void draw_robot(cv::Mat& out, const RobotDetection& robot, const Field& field,
                  const std::vector<Blob>& blobs);
  void draw_ball(cv::Mat& out, const FrameResult& result, const Field& field);
  void draw_caption(cv::Mat& out, const FrameResult& result);

  cv::Scalar color_of(Label label) const;

  const Palette& palette_;
  OverlayOptions options_;
  int scale_ = 1;
  std::optional<Timestamp> first_captured_;  // the caption counts from here
  std::deque<cv::Point2d> ball_trail_px_;
  std::vector<cv::Point2d> points_px_;
  std::vector<cv::Point> points_;
};

}  // namespace maggic
