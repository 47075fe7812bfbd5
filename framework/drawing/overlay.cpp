#include "maggic/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace maggic {
namespace {

constexpr int kSmallWidthPx = 960;
constexpr int kCaptionHeightPx = 26;  // even, so that the canvas stays even
constexpr int kSubpixelBits = 4;      // cv's drawing functions take fixed-point coordinates
const cv::Scalar kRim(20, 20, 20);
const cv::Scalar kFieldColor(255, 190, 220);  // unlike any field's own lines and any tag
const cv::Scalar kPaper(245, 245, 245);
const cv::Scalar kBallColor(0, 140, 255);
const cv::Scalar kBlueTeam(255, 150, 60);  // lighter than the tag's blue, to be read on black
const cv::Scalar kYellowTeam(40, 230, 255);

constexpr double kArrowMm = 65.0;
constexpr double kRobotRadiusMm = 53.0;  // half the diagonal of a 75 mm cube
constexpr double kAxisMm = 150.0;

int even(int n) { return n + n % 2; }

double pixels_per_mm(const Field& field, cv::Point2d point_px, double height_mm) {
  const double mm2_per_px2 = field.mm2_per_px2(point_px, height_mm);
  return mm2_per_px2 > 0.0 ? 1.0 / std::sqrt(mm2_per_px2) : 1.0;
}

/// Corners of the rectangle that has the blob's centroid and second moments.
std::array<cv::Point2d, 4> equivalent_rectangle(const Blob& blob) {
  const double mean = (blob.moment_xx_px2 + blob.moment_yy_px2) / 2.0;
  const double half_difference = (blob.moment_xx_px2 - blob.moment_yy_px2) / 2.0;
  const double root = std::hypot(half_difference, blob.moment_xy_px2);
  const double angle = std::atan2(blob.moment_xy_px2, half_difference) / 2.0;
  // A side of length w has the second moment w²/12.
  const double half_long = std::sqrt(12.0 * std::max(0.0, mean + root)) / 2.0;
  const double half_short = std::sqrt(12.0 * std::max(0.0, mean - root)) / 2.0;
  const cv::Point2d along(std::cos(angle), std::sin(angle));
  const cv::Point2d across(-along.y, along.x);
  const cv::Point2d a = along * half_long;
  const cv::Point2d b = across * half_short;
  const cv::Point2d c = blob.centroid_px;
  return {c + a + b, c - a + b, c - a - b, c + a - b};
}

const Blob* blob_of(const TagSighting& tag, const std::vector<Blob>& blobs) {
  for (const Blob& blob : blobs) {
    const cv::Point2d offset = blob.centroid_px - tag.centroid_px;
    if (blob.label == tag.label && std::abs(offset.x) < 0.5 && std::abs(offset.y) < 0.5) {
      return &blob;
    }
  }
  return nullptr;
}

}  // namespace

Overlay::Overlay(const Palette& palette, OverlayOptions options)
    : palette_(palette), options_(options) {}

int Overlay::scale_for(cv::Size frame_size_px) const {
  if (options_.scale > 0) return options_.scale;
  return frame_size_px.width < kSmallWidthPx ? 2 : 1;
}

cv::Size Overlay::size_for(cv::Size frame_size_px) const {
  const int scale = scale_for(frame_size_px);
  return {even(frame_size_px.width * scale),
          even(frame_size_px.height * scale) + (options_.caption ? kCaptionHeightPx : 0)};
}

void Overlay::draw(const FrameResult& result, const Field& field, cv::Mat& out) {
  const cv::Mat& picture = result.frame.bgr;
  scale_ = scale_for(picture.size());
  out.create(size_for(picture.size()), CV_8UC3);
  out.setTo(cv::Scalar::all(0));
  cv::Mat canvas_picture = out(cv::Rect(0, 0, picture.cols * scale_, picture.rows * scale_));
  if (scale_ == 1) {
    picture.copyTo(canvas_picture);
  } else {
    cv::resize(picture, canvas_picture, canvas_picture.size(), 0, 0, cv::INTER_LINEAR);
  }
  if (options_.field_lines) draw_field(canvas_picture, field);
  for (const RobotDetection& robot : result.detections.robots) {
    draw_robot(canvas_picture, robot, field, result.blobs);
  }
  draw_ball(canvas_picture, result, field);
  if (options_.caption) draw_caption(out, result);
}

cv::Point Overlay::canvas(cv::Point2d point_px) const {
  // Pixel centres are whole numbers in both pictures, so the enlargement is about (-½, -½). The
  // bound keeps far-off points (a wild calibration) inside what fixed point can hold.
  const auto fixed = [this](double v) {
    const double scaled = (v + 0.5) * scale_ - 0.5;
    return static_cast<int>(
        std::lround(std::clamp(scaled, -30000.0, 30000.0) * (1 << kSubpixelBits)));
  };
  return {fixed(point_px.x), fixed(point_px.y)};
}

void Overlay::polyline(cv::Mat& out, const std::vector<cv::Point2d>& points_px, bool closed,
                       cv::Scalar color, int thickness) {
  points_.clear();
  for (const cv::Point2d& p : points_px) points_.push_back(canvas(p));
  cv::polylines(out, points_, closed, kRim, thickness + 2, cv::LINE_AA, kSubpixelBits);
  cv::polylines(out, points_, closed, color, thickness, cv::LINE_AA, kSubpixelBits);
}

void Overlay::dashed_circle(cv::Mat& out, cv::Point2d center_px, double radius_px, cv::Scalar color,
                            int thickness) {
  constexpr int kDashes = 10;
  constexpr int kPointsPerDash = 5;
  for (int dash = 0; dash < kDashes; ++dash) {
    points_px_.clear();
    for (int i = 0; i < kPointsPerDash; ++i) {
      const double turn = (dash + 0.6 * i / (kPointsPerDash - 1)) / kDashes;
      const double angle = turn * 2.0 * CV_PI;
      points_px_.push_back(center_px + cv::Point2d(std::cos(angle), std::sin(angle)) * radius_px);
    }
    polyline(out, points_px_, false, color, thickness);
  }
}

void Overlay::text(cv::Mat& out, const std::string& what, cv::Point2d canvas_px, double size,
                   cv::Scalar color) {
  const cv::Point origin(cvRound(canvas_px.x), cvRound(canvas_px.y));
  cv::putText(out, what, origin, cv::FONT_HERSHEY_SIMPLEX, size, kRim, 5, cv::LINE_AA);
  cv::putText(out, what, origin, cv::FONT_HERSHEY_SIMPLEX, size, color, 2, cv::LINE_AA);
}

cv::Scalar Overlay::color_of(Label label) const {
  const DisplayColor c = palette_.display_color(label);
  return cv::Scalar(c.blue, c.green, c.red);
}

void Overlay::draw_field(cv::Mat& out, const Field& field) {
  const double x = field.parameters().length_mm / 2.0;
  const double y = field.parameters().width_mm / 2.0;
  // A straight line of the field is curved in a picture with lens distortion: many short pieces.
  const auto line = [&](cv::Point2d from_mm, cv::Point2d to_mm) {
    constexpr int kPieces = 16;
    for (int i = 0; i <= kPieces; ++i) {
      const cv::Point2d at_mm = from_mm + (to_mm - from_mm) * (static_cast<double>(i) / kPieces);
      points_px_.push_back(field.to_image_px(at_mm, 0.0));
    }
  };
  points_px_.clear();
  line({-x, y}, {x, y});
  line({x, y}, {x, -y});
  line({x, -y}, {-x, -y});
  line({-x, -y}, {-x, y});
  polyline(out, points_px_, true, kFieldColor, 1);
  const auto axis = [&](cv::Point2d to_mm, cv::Scalar color) {
    points_px_.clear();
    line({0, 0}, to_mm);
    polyline(out, points_px_, false, color, 1);
  };
  axis({kAxisMm, 0}, cv::Scalar(60, 60, 255));
  axis({0, kAxisMm}, cv::Scalar(60, 220, 60));
}

void Overlay::draw_patch(cv::Mat& out, const TagSighting& tag, const std::vector<Blob>& blobs) {
  points_px_.clear();
  if (const Blob* blob = blob_of(tag, blobs)) {
    const auto corners = equivalent_rectangle(*blob);
    points_px_.assign(corners.begin(), corners.end());
  } else {
    constexpr int kSides = 12;
    const double radius_px = std::sqrt(std::max(tag.area_px, 1.0) / CV_PI);
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * CV_PI * i / kSides;
      points_px_.push_back(tag.centroid_px +
                           cv::Point2d(std::cos(angle), std::sin(angle)) * radius_px);
    }
  }
  polyline(out, points_px_, true, color_of(tag.label), 2);
}

void Overlay::draw_robot(cv::Mat& out, const RobotDetection& robot, const Field& field,
                         const std::vector<Blob>& blobs) {
  const double height_mm = field.robot_height_mm();
  const double radius_px = kRobotRadiusMm * pixels_per_mm(field, robot.centroid_px, height_mm);
  const cv::Scalar color = robot.team == Team::kBlue ? kBlueTeam : kYellowTeam;
  for (const TagSighting& tag : robot.tags) draw_patch(out, tag, blobs);
  if (robot.state == TrackState::kPredicted) {
    dashed_circle(out, robot.centroid_px, radius_px, color, 2);
  }

  const cv::Point2d front_mm =
      robot.position_mm +
      cv::Point2d(std::cos(robot.heading_rad), std::sin(robot.heading_rad)) * kArrowMm;
  const cv::Point2d arrow_px =
      field.to_image_px(front_mm, height_mm) - field.to_image_px(robot.position_mm, height_mm);
  const cv::Point2d tip_px = robot.centroid_px + arrow_px;
  const cv::Point2d side_px(-arrow_px.y, arrow_px.x);
  points_px_ = {robot.centroid_px, tip_px};
  polyline(out, points_px_, false, kPaper, 2);
  points_px_ = {tip_px - arrow_px * 0.25 + side_px * 0.15, tip_px,
                tip_px - arrow_px * 0.25 - side_px * 0.15};
  polyline(out, points_px_, false, kPaper, 2);

  const std::string id = robot.id == kUnknownId ? "?" : std::to_string(robot.id);
  const std::string name = (robot.team == Team::kBlue ? "B" : "Y") + id;
  const cv::Point2d label_px = (robot.centroid_px + cv::Point2d(0.62, -0.72) * radius_px) * scale_;
  text(out, name, label_px, 0.7, color);
}

void Overlay::draw_ball(cv::Mat& out, const FrameResult& result, const Field& field) {
  const auto& ball = result.detections.ball;
  if (!ball) {
    ball_trail_px_.clear();
    return;
  }
  ball_trail_px_.push_back(ball->centroid_px);
  while (ball_trail_px_.size() > static_cast<std::size_t>(options_.ball_trail_frames) + 1) {
    ball_trail_px_.pop_front();
  }
  // No rim here: a thin coloured line that fades is seen well enough and hides little.
  for (std::size_t i = 1; i < ball_trail_px_.size(); ++i) {
    const double freshness = static_cast<double>(i) / static_cast<double>(ball_trail_px_.size());
    cv::line(out, canvas(ball_trail_px_[i - 1]), canvas(ball_trail_px_[i]),
             kBallColor * (0.35 + 0.65 * freshness), freshness > 0.6 ? 2 : 1, cv::LINE_AA,
             kSubpixelBits);
  }
  const double px_per_mm = pixels_per_mm(field, ball->centroid_px, field.ball_height_mm());
  const double radius_px = 30.0 * px_per_mm;  // well outside the ball itself, so it stays visible
  if (ball->state == TrackState::kPredicted) {
    dashed_circle(out, ball->centroid_px, radius_px, kBallColor, 2);
  } else {
    const int radius = static_cast<int>(std::lround(radius_px * scale_ * (1 << kSubpixelBits)));
    const cv::Point center = canvas(ball->centroid_px);
    cv::circle(out, center, radius, kRim, 4, cv::LINE_AA, kSubpixelBits);
    cv::circle(out, center, radius, kBallColor, 2, cv::LINE_AA, kSubpixelBits);
  }
  const double speed_m_s = std::hypot(ball->velocity_mm_s.x, ball->velocity_mm_s.y) / 1000.0;
  const cv::Point2d label_px = (ball->centroid_px + cv::Point2d(0.8, 1.5) * radius_px) * scale_;
  text(out, fmt::format("{:.1f} m/s", speed_m_s), label_px, 0.5, kBallColor);
}

void Overlay::draw_caption(cv::Mat& out, const FrameResult& result) {
  const auto ms = [&](std::chrono::nanoseconds t) {
    return std::chrono::duration<double, std::milli>(t).count();
  };
  if (!first_captured_) first_captured_ = result.detections.captured;
  const double elapsed_s =
      std::chrono::duration<double>(result.detections.captured - *first_captured_).count();
  const std::size_t robots = result.detections.robots.size();
  const std::string wide = fmt::format(
      "frame {}  {:.2f} s   {} robot{}{}   segment {:.2f} + blobs {:.2f} + track {:.2f}"
      " = {:.2f} ms   (read {:.2f})",
      result.detections.sequence, elapsed_s, robots, robots == 1 ? "" : "s",
      result.detections.ball ? " + ball" : "", ms(result.times[Step::kSegment]),
      ms(result.times[Step::kBlobs]), ms(result.times[Step::kTrack]), ms(result.times.frame_path()),
      ms(result.times[Step::kRead]));
  const std::string narrow =
      fmt::format("frame {}  {:.2f} ms", result.detections.sequence, ms(result.times.frame_path()));
  int baseline = 0;
  const int wide_px = cv::getTextSize(wide, cv::FONT_HERSHEY_SIMPLEX, 0.5, 1, &baseline).width;
  cv::putText(out, wide_px + 12 < out.cols ? wide : narrow, cv::Point(6, out.rows - 9),
              cv::FONT_HERSHEY_SIMPLEX, 0.5, kPaper, 1, cv::LINE_AA);
}

}  // namespace maggic
