#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "field/corners.hpp"
#include "maggic/field.hpp"

namespace maggic {
namespace {

constexpr Range<double> kPixelRange{-100'000.0, 100'000.0};

void describe_lens(Parameters& p, FieldParameters& field) {
  p.number({"k1", "first radial term of OpenCV's lens model, negative for barrel distortion"},
           field.lens_k1, {-5.0, 5.0});
  p.number({"k2", "second radial term"}, field.lens_k2, {-5.0, 5.0});
  p.number({"focal_length_px", "focal length; the picture's width where left out", "px"},
           field.focal_length_px, {1.0, 100'000.0});
  p.point({"principal_point_px", "where the optical axis meets the picture; its centre where left "
                                 "out", "px"},
          field.principal_point_px, kPixelRange);
}

void describe_camera(Parameters& p, FieldParameters& field) {
  p.number({"height_mm", "height of the lens above the floor", "mm"}, field.camera_height_mm,
           {100.0, 50'000.0});
  p.point({"position_mm", "point of the floor below the lens, from the field's centre", "mm"},
          field.camera_position_mm, {-50'000.0, 50'000.0});
}

void describe_image_size(Parameters& p, cv::Size& size) {
  std::array<double, 2> wh{static_cast<double>(size.width), static_cast<double>(size.height)};
  p.numbers({"image_size_px", "width and height of the picture the corners were taken in; corners "
                              "and lens scale with frames of another size; [0, 0]: every frame's "
                              "own size", "px"},
            wh, {0.0, 65'535.0});
  const bool whole = std::ranges::all_of(wh, [](double v) { return v == std::floor(v); });
  const bool both = (wh[0] > 0.0) == (wh[1] > 0.0);
  p.check("image_size_px", whole && both,
          "expected two whole numbers, both at least 1 (or [0, 0] for every frame's own size)");
  if (whole && both) size = {static_cast<int>(wh[0]), static_cast<int>(wh[1])};
}

}  // namespace

void FieldParameters::describe(Parameters& p) {
  const FieldFormat before = format;
  p.choice<FieldFormat>({"format", "field size by league: 3v3 is 1500 x 1300 mm, 5v5 is "
                                   "2200 x 1800 mm"},
                        format, {{"3v3", FieldFormat::k3v3}, {"5v5", FieldFormat::k5v5}});
  if (format != before) {
    length_mm = format == FieldFormat::k5v5 ? 2200.0 : 1500.0;
    width_mm = format == FieldFormat::k5v5 ? 1800.0 : 1300.0;
  }
  p.number({"length_mm", "extent from goal line to goal line; the format's where left out", "mm"},
           length_mm, {100.0, 50'000.0});
  p.number({"width_mm", "extent from side to side; the format's where left out", "mm"}, width_mm,
           {100.0, 50'000.0});

  p.list({"corners_px", "top-left, top-right, bottom-right, bottom-left corner of the field in the "
                        "picture, as [x, y]; left out: the field fills the picture", "px"},
         corners_px, {0, 4}, [](Parameters& element, cv::Point2d& corner) {
           element.point({"", "one corner", "px"}, corner, kPixelRange);
         });
  const std::string mistake = corners_px.empty() ? std::string{} : mistake_in_corners(corners_px);
  p.check("corners_px", mistake.empty(),
          mistake.empty() ? "expected four corners of a convex field" : mistake);
  describe_image_size(p, image_size_px);

  p.group({"lens", "radial distortion of the lens"},
          [this](Parameters& lens) { describe_lens(lens, *this); });
  p.group({"camera", "where the camera hangs, for correcting parallax"},
          [this](Parameters& camera) { describe_camera(camera, *this); });
  p.number({"robot_height_mm", "height of the robots' tags above the floor", "mm"},
           robot_height_mm, {0.0, 1000.0});
  p.number({"ball_height_mm", "height of the ball's centre above the floor", "mm"}, ball_height_mm,
           {0.0, 1000.0});
  p.check("robot_height_mm", robot_height_mm < camera_height_mm,
          "the robots' tags are as high as the camera: expected less than camera.height_mm");
  p.check("ball_height_mm", ball_height_mm < camera_height_mm,
          "the ball is as high as the camera: expected less than camera.height_mm");
  p.boolean({"half_time", "turn the field frame by 180 degrees, for the half after changing sides"},
            half_time);
}

}  // namespace maggic
