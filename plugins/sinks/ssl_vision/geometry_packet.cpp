#include "geometry_packet.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "ssl_vision.pb.h"

namespace maggic::ssl_vision {
namespace {

std::int32_t whole_mm(double length_mm) {
  return static_cast<std::int32_t>(std::lround(length_mm));
}

void set(Vector2f& out, cv::Point2d point_mm) {
  out.set_x(static_cast<float>(point_mm.x));
  out.set_y(static_cast<float>(point_mm.y));
}

// Names are written out: protobuf would keep the table it looks them up in beyond the plugin's end.
class Lines {
 public:
  Lines(SSL_GeometryFieldSize& field, double thickness_mm)
      : field_(field), thickness_mm_(static_cast<float>(thickness_mm)) {}

  void add(std::string_view name, SSL_FieldShapeType type, cv::Point2d from_mm, cv::Point2d to_mm) {
    SSL_FieldLineSegment& line = *field_.add_field_lines();
    line.set_name(name.data(), name.size());
    line.set_type(type);
    set(*line.mutable_p1(), from_mm);
    set(*line.mutable_p2(), to_mm);
    line.set_thickness(thickness_mm_);
  }

  void add_circle(std::string_view name, SSL_FieldShapeType type, double radius_mm) {
    SSL_FieldCircularArc& arc = *field_.add_field_arcs();
    arc.set_name(name.data(), name.size());
    arc.set_type(type);
    set(*arc.mutable_center(), {0.0, 0.0});
    arc.set_radius(static_cast<float>(radius_mm));
    arc.set_a1(0.0F);
    arc.set_a2(2.0F * std::numbers::pi_v<float>);
    arc.set_thickness(thickness_mm_);
  }

 private:
  SSL_GeometryFieldSize& field_;
  float thickness_mm_;
};

}  // namespace

std::string geometry_packet(const FieldParameters& field, const network::FieldMarkings& markings) {
  SSL_WrapperPacket packet;
  SSL_GeometryFieldSize& out = *packet.mutable_geometry()->mutable_field();
  out.set_field_length(whole_mm(field.length_mm));
  out.set_field_width(whole_mm(field.width_mm));
  out.set_goal_width(whole_mm(markings.goal_width_mm));
  out.set_goal_depth(whole_mm(markings.goal_depth_mm));
  out.set_boundary_width(0);
  out.set_penalty_area_depth(whole_mm(markings.goal_area_depth_mm));
  out.set_penalty_area_width(whole_mm(markings.goal_area_width_mm));
  out.set_center_circle_radius(whole_mm(markings.center_circle_radius_mm));
  out.set_line_thickness(whole_mm(markings.line_thickness_mm));

  const double x = field.length_mm / 2.0;
  const double y = field.width_mm / 2.0;
  const double area_x = x - markings.goal_area_depth_mm;
  const double area_y = markings.goal_area_width_mm / 2.0;
  Lines lines(out, markings.line_thickness_mm);
  lines.add("TopTouchLine", TopTouchLine, {-x, y}, {x, y});
  lines.add("BottomTouchLine", BottomTouchLine, {-x, -y}, {x, -y});
  lines.add("LeftGoalLine", LeftGoalLine, {-x, -y}, {-x, y});
  lines.add("RightGoalLine", RightGoalLine, {x, -y}, {x, y});
  lines.add("HalfwayLine", HalfwayLine, {0.0, -y}, {0.0, y});
  lines.add("LeftPenaltyStretch", LeftPenaltyStretch, {-area_x, -area_y}, {-area_x, area_y});
  lines.add("RightPenaltyStretch", RightPenaltyStretch, {area_x, -area_y}, {area_x, area_y});
  lines.add("LeftFieldLeftPenaltyStretch", LeftFieldLeftPenaltyStretch, {-x, -area_y},
            {-area_x, -area_y});
  lines.add("LeftFieldRightPenaltyStretch", LeftFieldRightPenaltyStretch, {-x, area_y},
            {-area_x, area_y});
  lines.add("RightFieldLeftPenaltyStretch", RightFieldLeftPenaltyStretch, {x, area_y},
            {area_x, area_y});
  lines.add("RightFieldRightPenaltyStretch", RightFieldRightPenaltyStretch, {x, -area_y},
            {area_x, -area_y});
  lines.add_circle("CenterCircle", CenterCircle, markings.center_circle_radius_mm);
  return packet.SerializeAsString();
}

}  // namespace maggic::ssl_vision
