#include "geometry_packet.hpp"

#include <set>

#include <gmock/gmock.h>

#include "packet_size.hpp"
#include "ssl_vision.pb.h"

namespace maggic::ssl_vision {
namespace {

SSL_GeometryFieldSize field_in(const std::string& packet) {
  SSL_WrapperPacket message;
  EXPECT_TRUE(message.ParseFromString(packet));
  EXPECT_FALSE(message.has_detection());
  return message.geometry().field();
}

const SSL_FieldLineSegment& line(const SSL_GeometryFieldSize& field, const std::string& name) {
  for (const SSL_FieldLineSegment& one : field.field_lines()) {
    if (one.name() == name) return one;
  }
  ADD_FAILURE() << "there is no line " << name;
  return SSL_FieldLineSegment::default_instance();
}

TEST(GeometryPacket, HoldsTheSizesOfThe3v3FieldByDefault) {
  const SSL_GeometryFieldSize field = field_in(geometry_packet({}, {}));
  EXPECT_EQ(field.field_length(), 1500);
  EXPECT_EQ(field.field_width(), 1300);
  EXPECT_EQ(field.goal_width(), 400);
  EXPECT_EQ(field.goal_depth(), 100);
  EXPECT_EQ(field.boundary_width(), 0);
  EXPECT_EQ(field.penalty_area_width(), 700);
  EXPECT_EQ(field.penalty_area_depth(), 150);
  EXPECT_EQ(field.center_circle_radius(), 200);
  EXPECT_EQ(field.line_thickness(), 3);
  ASSERT_EQ(field.field_arcs_size(), 1);
  EXPECT_EQ(field.field_arcs(0).name(), "CenterCircle");
  EXPECT_EQ(field.field_arcs(0).radius(), 200.0F);
}

TEST(GeometryPacket, DrawsTheLinesOfAnyField) {
  FieldParameters parameters;
  parameters.length_mm = 2200.0;
  parameters.width_mm = 1800.0;
  const network::FieldMarkings markings{.goal_area_width_mm = 800.0, .goal_area_depth_mm = 350.0};
  const SSL_GeometryFieldSize field = field_in(geometry_packet(parameters, markings));

  const SSL_FieldLineSegment& top = line(field, "TopTouchLine");
  EXPECT_EQ(top.type(), TopTouchLine);
  EXPECT_EQ(top.p1().x(), -1100.0F);
  EXPECT_EQ(top.p2().x(), 1100.0F);
  EXPECT_EQ(top.p1().y(), 900.0F);
  EXPECT_EQ(top.p2().y(), 900.0F);
  const SSL_FieldLineSegment& area = line(field, "LeftPenaltyStretch");
  EXPECT_EQ(area.p1().x(), -750.0F);
  EXPECT_EQ(area.p2().x(), -750.0F);
  EXPECT_EQ(area.p1().y(), -400.0F);
  EXPECT_EQ(area.p2().y(), 400.0F);
}

TEST(GeometryPacket, DrawsEveryGoalAreaAsARectangleWithTheGoalLine) {
  const SSL_GeometryFieldSize field = field_in(geometry_packet({}, {}));
  for (const std::string side : {"Left", "Right"}) {
    const SSL_FieldLineSegment& front = line(field, side + "PenaltyStretch");
    const SSL_FieldLineSegment& goal_line = line(field, side + "GoalLine");
    std::set<float> ends;
    for (const std::string flank : {"Left", "Right"}) {
      const SSL_FieldLineSegment& stretch = line(field, side + "Field" + flank + "PenaltyStretch");
      EXPECT_EQ(stretch.p1().x(), goal_line.p1().x());
      EXPECT_EQ(stretch.p2().x(), front.p1().x());
      EXPECT_EQ(stretch.p1().y(), stretch.p2().y());
      ends.insert(stretch.p1().y());
    }
    EXPECT_EQ(ends, (std::set<float>{front.p1().y(), front.p2().y()}));
  }
}

TEST(GeometryPacket, FitsTheBuffersOfClients) {
  FieldParameters parameters;
  parameters.length_mm = 100'000.0;
  parameters.width_mm = 100'000.0;
  EXPECT_LE(geometry_packet(parameters, {}).size(), kMaxPacketBytes);
}

}  // namespace
}  // namespace maggic::ssl_vision
