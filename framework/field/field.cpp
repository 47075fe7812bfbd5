#include "maggic/field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "field/corners.hpp"

namespace maggic {
namespace {

/// Rays this near to the horizon (or behind it) are taken for the horizon's edge: far, but finite.
constexpr double kMinDepth = 1e-9;

cv::Point2d project(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1.0);
  const double w = std::max(q[2], kMinDepth);
  return {q[0] / w, q[1] / w};
}

/// Derivative of `project`.
cv::Matx22d project_jacobian(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1.0);
  const bool clamped = q[2] < kMinDepth;
  const double w = clamped ? kMinDepth : q[2];
  const double wx = clamped ? 0.0 : h(2, 0);
  const double wy = clamped ? 0.0 : h(2, 1);
  return {(h(0, 0) - wx * q[0] / w) / w, (h(0, 1) - wy * q[0] / w) / w,
          (h(1, 0) - wx * q[1] / w) / w, (h(1, 1) - wy * q[1] / w) / w};
}

/// The homography that takes (-1,1), (1,1), (1,-1), (-1,-1) to the four points. Its last element
/// is 1, which is no restriction here: the square's centre is always inside a convex image.
cv::Matx33d homography_from_square(const std::array<cv::Point2d, 4>& image) {
  constexpr std::array<std::array<double, 2>, 4> kSquare{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
  cv::Matx<double, 8, 8> a;
  cv::Matx<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const auto [x, y] = kSquare[static_cast<std::size_t>(i)];
    const auto [u, v] = image[static_cast<std::size_t>(i)];
    const double rows[2][8] = {{x, y, 1, 0, 0, 0, -u * x, -u * y},
                               {0, 0, 0, x, y, 1, -v * x, -v * y}};
    for (int k = 0; k < 8; ++k) {
      a(2 * i, k) = rows[0][k];
      a(2 * i + 1, k) = rows[1][k];
    }
    b(2 * i) = u;
    b(2 * i + 1) = v;
  }
  const cv::Matx<double, 8, 1> h = a.solve(b, cv::DECOMP_LU);
  return {h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0};
}

void check_heights(const FieldParameters& p) {
  for (const double height : {p.robot_height_mm, p.ball_height_mm}) {
    if (!(height < p.camera_height_mm)) {
      throw std::invalid_argument(
          fmt::format("an object {} mm high under a camera {} mm high: expected it lower than the "
                      "camera", height, p.camera_height_mm));
    }
  }
}

}  // namespace

std::vector<cv::Point2d> fitted_corners_px(const FieldParameters& parameters, cv::Size picture_px,
                                           double margin_px) {
  const double scale = std::min((picture_px.width - 2.0 * margin_px) / parameters.length_mm,
                                (picture_px.height - 2.0 * margin_px) / parameters.width_mm);
  const cv::Point2d center(0.5 * (picture_px.width - 1), 0.5 * (picture_px.height - 1));
  const double x = 0.5 * scale * parameters.length_mm;
  const double y = 0.5 * scale * parameters.width_mm;
  return {center + cv::Point2d(-x, -y), center + cv::Point2d(x, -y), center + cv::Point2d(x, y),
          center + cv::Point2d(-x, y)};
}

Field::Field(const FieldParameters& parameters, cv::Size frame_size_px)
    : parameters_(parameters),
      frame_size_px_(frame_size_px),
      lens_(parameters.lens_k1, parameters.lens_k2) {
  if (frame_size_px.width < 1 || frame_size_px.height < 1) {
    throw std::invalid_argument(fmt::format("a frame of {} x {} pixels: expected at least 1 x 1",
                                            frame_size_px.width, frame_size_px.height));
  }
  check_heights(parameters);
  const bool sized = parameters.image_size_px.width > 0 && parameters.image_size_px.height > 0;
  const cv::Size reference = sized ? parameters.image_size_px : frame_size_px;
  reference_per_frame_ = {static_cast<double>(reference.width) / frame_size_px.width,
                          static_cast<double>(reference.height) / frame_size_px.height};
  focal_px_ = parameters.focal_length_px.value_or(reference.width);
  principal_px_ = parameters.principal_point_px.value_or(
      cv::Point2d(0.5 * (reference.width - 1), 0.5 * (reference.height - 1)));

  const std::vector<cv::Point2d> corners_px = parameters.corners_px.empty()
                                                  ? fitted_corners_px(parameters, reference)
                                                  : parameters.corners_px;
  if (const std::string mistake = mistake_in_corners(corners_px); !mistake.empty()) {
    throw std::invalid_argument("field corners: " + mistake);
  }
  std::array<cv::Point2d, 4> rays;
  for (std::size_t i = 0; i < 4; ++i) rays[i] = undistort(corners_px[i]);
  if (!mistake_in_corners(rays).empty()) {
    throw std::invalid_argument(
        "field corners: they make no convex field once the lens is corrected: expected smaller "
        "lens terms k1, k2 or another focal length");
  }
  const cv::Matx33d square_from_floor = cv::Matx33d::diag(
      {2.0 / parameters.length_mm, 2.0 / parameters.width_mm, 1.0});
  ray_from_floor_ = homography_from_square(rays) * square_from_floor;
  // Inverting keeps the third coordinate positive on the field's side of the horizon.
  floor_from_ray_ = ray_from_floor_.inv(cv::DECOMP_LU);
}

cv::Point2d Field::undistort(cv::Point2d point_px) const {
  const cv::Point2d seen = (point_px - principal_px_) / focal_px_;
  const double radius = std::hypot(seen.x, seen.y);
  return radius > 0.0 ? seen * (lens_.undistort(radius) / radius) : seen;
}

cv::Point2d Field::distort(cv::Point2d ray) const {
  const double radius = std::hypot(ray.x, ray.y);
  const cv::Point2d seen = radius > 0.0 ? ray * (lens_.distort(radius) / radius) : ray;
  return seen * focal_px_ + principal_px_;
}

double Field::parallax_factor(double height_mm) const {
  return std::max(1.0 - height_mm / parameters_.camera_height_mm, 1e-6);
}

cv::Point2d Field::to_field_mm(cv::Point2d point_px, double height_mm) const {
  const cv::Point2d reference_px((point_px.x + 0.5) * reference_per_frame_.x - 0.5,
                                 (point_px.y + 0.5) * reference_per_frame_.y - 0.5);
  const cv::Point2d floor = project(floor_from_ray_, undistort(reference_px));
  const cv::Point2d below = parameters_.camera_position_mm;
  const cv::Point2d position = below + (floor - below) * parallax_factor(height_mm);
  return parameters_.half_time ? -position : position;
}

cv::Point2d Field::to_image_px(cv::Point2d position_mm, double height_mm) const {
  const cv::Point2d position = parameters_.half_time ? -position_mm : position_mm;
  const cv::Point2d below = parameters_.camera_position_mm;
  const cv::Point2d floor = below + (position - below) / parallax_factor(height_mm);
  const cv::Point2d reference_px = distort(project(ray_from_floor_, floor));
  return {(reference_px.x + 0.5) / reference_per_frame_.x - 0.5,
          (reference_px.y + 0.5) / reference_per_frame_.y - 0.5};
}

cv::Matx22d Field::jacobian_mm_per_px(cv::Point2d point_px, double height_mm) const {
  const cv::Point2d seen(
      ((point_px.x + 0.5) * reference_per_frame_.x - 0.5 - principal_px_.x) / focal_px_,
      ((point_px.y + 0.5) * reference_per_frame_.y - 0.5 - principal_px_.y) / focal_px_);
  // The lens stretches by 1/slope along the radius and by the ratio of radii across it.
  const double distorted = std::hypot(seen.x, seen.y);
  cv::Matx22d lens = cv::Matx22d::eye();
  cv::Point2d ray = seen;
  if (distorted > 0.0) {
    const double radius = lens_.undistort(distorted);
    const double across = radius / distorted;
    const double along = 1.0 / lens_.slope(radius);
    const cv::Point2d n = seen / distorted;
    const double d = along - across;
    lens = {across + d * n.x * n.x, d * n.x * n.y, d * n.x * n.y, across + d * n.y * n.y};
    ray = seen * across;
  }
  const double factor = parallax_factor(height_mm) * (parameters_.half_time ? -1.0 : 1.0);
  const cv::Matx22d frame(reference_per_frame_.x / focal_px_, 0.0, 0.0,
                          reference_per_frame_.y / focal_px_);
  return factor * (project_jacobian(floor_from_ray_, ray) * lens * frame);
}

double Field::mm2_per_px2(cv::Point2d point_px, double height_mm) const {
  const cv::Matx22d j = jacobian_mm_per_px(point_px, height_mm);
  return std::abs(j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0));
}

}  // namespace maggic
