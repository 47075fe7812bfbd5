#pragma once
/// The lines of a field, as points to look for in a picture.

#include <string_view>
#include <vector>

#include <opencv2/core/types.hpp>

#include "calibration/ridge_map.hpp"
#include "maggic/field.hpp"

namespace maggic::calibration {

/// A point of a line and the direction across it, on the floor.
struct ModelPoint {
  cv::Point2d position_mm;
  cv::Point2d across;  ///< Unit vector.
};

/// One line of the field: a straight piece, or the circle.
struct ModelLine {
  std::string_view name;
  double weight = 1.0;  ///< What seeing all of it is worth.
  /// Part of the field's outline: `across` points outwards, and where a wall stands instead of a
  /// line, its inner edge is meant.
  bool is_outline = false;
  std::vector<ModelPoint> points;
};

/// Boundary, centre line and circle, goal areas (rules of the league: circle of 200 mm radius, goal
/// area 150 × 700 mm). Which of them a field really has, and shows, differs from hall to hall.
std::vector<ModelLine> field_lines(const FieldParameters& field);

/// Where lines of a direction lie: x of the upright ones, y of the level ones, ascending, mm.
std::vector<double> line_places_mm(const FieldParameters& field, Direction direction);

}  // namespace maggic::calibration
