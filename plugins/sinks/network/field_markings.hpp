#pragma once
/// What is painted on and built at the field, beyond its length and width, for clients that ask.

#include "maggic/parameters.hpp"

namespace maggic::network {

/// The defaults are those of the 3v3 field.
struct FieldMarkings {
  double goal_width_mm = 400.0;
  double goal_depth_mm = 100.0;
  double goal_area_width_mm = 700.0;  ///< Along the goal line.
  double goal_area_depth_mm = 150.0;
  double center_circle_radius_mm = 200.0;
  double line_thickness_mm = 3.0;

  /// The group `markings`.
  void describe(Parameters& parameters) {
    parameters.group({"markings", "sizes of the field told to clients"}, [this](Parameters& p) {
      constexpr Range<double> kSizes{0.0, 100'000.0};
      p.number({"goal_width_mm", "width of the goals", "mm"}, goal_width_mm, kSizes);
      p.number({"goal_depth_mm", "depth of the goals", "mm"}, goal_depth_mm, kSizes);
      p.number({"goal_area_width_mm", "goal area, along the goal line", "mm"}, goal_area_width_mm,
               kSizes);
      p.number({"goal_area_depth_mm", "goal area, from the goal line", "mm"}, goal_area_depth_mm,
               kSizes);
      p.number({"center_circle_radius_mm", "radius of the centre circle", "mm"},
               center_circle_radius_mm, kSizes);
      p.number({"line_thickness_mm", "thickness of the lines", "mm"}, line_thickness_mm, kSizes);
    });
  }
};

}  // namespace maggic::network
