#include "calibration/field_model.hpp"

#include <cmath>
#include <numbers>

namespace maggic::calibration {
namespace {

constexpr double kStepMm = 25.0;
constexpr double kGoalAreaDepthMm = 150.0;
constexpr double kGoalAreaWidthMm = 700.0;
constexpr double kCircleRadiusMm = 200.0;
constexpr double kCornerTriangleMm = 70.0;

ModelLine straight(std::string_view name, double weight, cv::Point2d from, cv::Point2d to) {
  ModelLine line{name, weight, false, {}};
  const cv::Point2d along = to - from;
  const double length = std::hypot(along.x, along.y);
  const cv::Point2d across(-along.y / length, along.x / length);
  const int steps = static_cast<int>(length / kStepMm);
  // Not the very ends, where lines meet.
  for (int i = 1; i < steps; ++i) line.points.push_back({from + along * (1.0 * i / steps), across});
  return line;
}

/// With the field on its right hand, so that `across` points outwards.
ModelLine outline(std::string_view name, cv::Point2d from, cv::Point2d to) {
  ModelLine line = straight(name, 1.0, from, to);
  line.is_outline = true;
  return line;
}

}  // namespace

std::vector<ModelLine> field_lines(const FieldParameters& field) {
  const double x = field.length_mm / 2.0;
  const double y = field.width_mm / 2.0;
  const double area_x = x - kGoalAreaDepthMm;
  const double area_y = kGoalAreaWidthMm / 2.0;
  const double side = x - kCornerTriangleMm;
  std::vector<ModelLine> lines{
      straight("centre line", 1.5, {0, -y}, {0, y}),
      outline("top side", {-side, y}, {side, y}),
      outline("bottom side", {side, -y}, {-side, -y}),
      outline("left goal line", {-x, -y + kCornerTriangleMm}, {-x, y - kCornerTriangleMm}),
      outline("right goal line", {x, y - kCornerTriangleMm}, {x, -y + kCornerTriangleMm}),
      straight("left goal area", 1.0, {-area_x, -area_y}, {-area_x, area_y}),
      straight("right goal area", 1.0, {area_x, -area_y}, {area_x, area_y}),
      straight("left goal area, top", 0.5, {-x, area_y}, {-area_x, area_y}),
      straight("left goal area, bottom", 0.5, {-x, -area_y}, {-area_x, -area_y}),
      straight("right goal area, top", 0.5, {area_x, area_y}, {x, area_y}),
      straight("right goal area, bottom", 0.5, {area_x, -area_y}, {x, -area_y})};
  ModelLine circle{"centre circle", 1.0, false, {}};
  constexpr int kCirclePoints = 48;
  for (int i = 0; i < kCirclePoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCirclePoints;
    const cv::Point2d out(std::cos(angle), std::sin(angle));
    circle.points.push_back({kCircleRadiusMm * out, out});
  }
  lines.push_back(std::move(circle));
  std::erase_if(lines, [](const ModelLine& line) { return line.points.empty(); });
  return lines;
}

std::vector<double> line_places_mm(const FieldParameters& field, Direction direction) {
  if (direction == Direction::kLevel) {
    const double y = field.width_mm / 2.0;
    const double area = kGoalAreaWidthMm / 2.0;
    return {-y, -area, area, y};
  }
  const double x = field.length_mm / 2.0;
  return {-x, -x + kGoalAreaDepthMm, 0.0, x - kGoalAreaDepthMm, x};
}

}  // namespace maggic::calibration
