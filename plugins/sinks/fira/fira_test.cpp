#include <string>

#include <gmock/gmock.h>

#include "fira.pb.h"
#include "maggic/testing.hpp"
#include "network/robot_for_tests.hpp"
#include "network/udp_receiver_for_tests.hpp"

namespace {

using maggic::network::robot;
using maggic::testing::standard_palette;
using ::testing::IsEmpty;

class FiraSink : public ::testing::Test {
 protected:
  std::string bytes_of(const maggic::FrameResult& result, const std::string& more = "") {
    const auto sink = maggic::testing::make<maggic::Sink>("fira", client_.parameters(more));
    sink->open({standard_palette(), {}});
    sink->write(result, field_);
    const std::string bytes = client_.receive();
    EXPECT_TRUE(client_.is_empty());
    return bytes;
  }

  fira_message::Environment sent(const maggic::FrameResult& result, const std::string& more = "") {
    fira_message::Environment packet;
    EXPECT_TRUE(packet.ParseFromString(bytes_of(result, more)));
    return packet;
  }

  maggic::network::UdpReceiver client_;
  const maggic::Field field_{maggic::FieldParameters{}, cv::Size(640, 480)};
};

TEST_F(FiraSink, KeepsTheSinkContract) {
  EXPECT_THAT(
      maggic::testing::check_conformance(maggic::StageKind::kSink, "fira", client_.parameters()),
      IsEmpty());
}

TEST_F(FiraSink, SendsRobotsAndBallInMetres) {
  maggic::FrameResult result;
  result.detections.sequence = 12;
  result.detections.robots = {robot(maggic::Team::kBlue, 1), robot(maggic::Team::kYellow, 2)};
  result.detections.robots[1].state = maggic::TrackState::kPredicted;
  result.detections.ball = maggic::BallDetection{};
  result.detections.ball->position_mm = {-250.0, 125.0};
  result.detections.ball->velocity_mm_s = {500.0, -750.0};
  const fira_message::Environment packet = sent(result);
  EXPECT_EQ(packet.step(), 12U);
  ASSERT_EQ(packet.frame().robots_blue_size(), 1);
  const fira_message::Robot& blue = packet.frame().robots_blue(0);
  EXPECT_EQ(blue.robot_id(), 1U);
  EXPECT_DOUBLE_EQ(blue.x(), 0.5);
  EXPECT_DOUBLE_EQ(blue.y(), -0.25);
  EXPECT_DOUBLE_EQ(blue.orientation(), 0.5);
  EXPECT_DOUBLE_EQ(blue.vx(), 1.0);
  EXPECT_DOUBLE_EQ(blue.vy(), -2.0);
  EXPECT_DOUBLE_EQ(blue.vorientation(), -3.0);
  ASSERT_EQ(packet.frame().robots_yellow_size(), 1);
  EXPECT_EQ(packet.frame().robots_yellow(0).robot_id(), 2U);
  EXPECT_DOUBLE_EQ(packet.frame().ball().x(), -0.25);
  EXPECT_DOUBLE_EQ(packet.frame().ball().y(), 0.125);
  EXPECT_DOUBLE_EQ(packet.frame().ball().z(), 0.02135);
  EXPECT_DOUBLE_EQ(packet.frame().ball().vx(), 0.5);
  EXPECT_DOUBLE_EQ(packet.frame().ball().vy(), -0.75);
}

TEST_F(FiraSink, SendsTheField) {
  const fira_message::Field field = sent({}, ", markings: {goal_width_mm: 450}").field();
  EXPECT_DOUBLE_EQ(field.length(), 1.5);
  EXPECT_DOUBLE_EQ(field.width(), 1.3);
  EXPECT_DOUBLE_EQ(field.goal_width(), 0.45);
  EXPECT_DOUBLE_EQ(field.goal_depth(), 0.1);
  EXPECT_DOUBLE_EQ(field.center_radius(), 0.2);
  EXPECT_DOUBLE_EQ(field.penalty_width(), 0.7);
  EXPECT_DOUBLE_EQ(field.penalty_depth(), 0.15);
}

TEST_F(FiraSink, LeavesOutRobotsWithoutAnIdAndABallThatIsNotThere) {
  maggic::FrameResult result;
  result.detections.robots = {robot(maggic::Team::kBlue, maggic::kUnknownId)};
  const fira_message::Environment packet = sent(result);
  EXPECT_TRUE(packet.has_frame());
  EXPECT_EQ(packet.frame().robots_blue_size(), 0);
  EXPECT_FALSE(packet.frame().has_ball());
}

TEST_F(FiraSink, FitsTheSmallestBufferOfClientsIn3v3) {
  maggic::FrameResult result;
  result.detections.sequence = 0xFFFF'FFFF;
  result.detections.ball = maggic::BallDetection{};
  result.detections.ball->position_mm = result.detections.ball->velocity_mm_s = {1.1, 1.1};
  for (const maggic::Team team : {maggic::Team::kBlue, maggic::Team::kYellow}) {
    for (int id = 1; id <= 3; ++id) result.detections.robots.push_back(robot(team, id));
  }
  EXPECT_LE(bytes_of(result).size(), 512U);
}

}  // namespace
