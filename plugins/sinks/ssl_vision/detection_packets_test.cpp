#include "detection_packets.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "packet_size.hpp"
#include "ssl_vision.pb.h"

namespace maggic::ssl_vision {
namespace {

using ::testing::SizeIs;

RobotDetection robot(Team team, int id) {
  RobotDetection robot;
  robot.team = team;
  robot.id = id;
  robot.position_mm = {100.5 + id, -20.25};
  robot.heading_rad = -1.5;
  robot.centroid_px = {320.5, 200.25};
  robot.confidence = 0.75;
  return robot;
}

SSL_WrapperPacket parsed(const std::string& packet) {
  SSL_WrapperPacket message;
  EXPECT_TRUE(message.ParseFromString(packet));
  return message;
}

SSL_DetectionFrame only_frame(const Detections& found, const PacketContext& context = {}) {
  const std::vector<std::string> packets = detection_packets(found, context);
  EXPECT_THAT(packets, SizeIs(1));
  return parsed(packets.front()).detection();
}

TEST(DetectionPacket, HoldsNumberTimesAndCamera) {
  Detections found;
  found.sequence = 12;
  found.captured = std::chrono::nanoseconds(1'700'000'000'250'000'000);
  const SSL_DetectionFrame frame = only_frame(found, {.t_sent_s = 1'700'000'000.5, .camera_id = 3});
  EXPECT_EQ(frame.frame_number(), 12U);
  EXPECT_DOUBLE_EQ(frame.t_capture(), 1'700'000'000.25);
  EXPECT_DOUBLE_EQ(frame.t_sent(), 1'700'000'000.5);
  EXPECT_EQ(frame.camera_id(), 3U);
}

TEST(DetectionPacket, IsSentForAFrameInWhichNothingWasSeen) {
  const SSL_DetectionFrame frame = only_frame({});
  EXPECT_EQ(frame.balls_size(), 0);
  EXPECT_EQ(frame.robots_blue_size() + frame.robots_yellow_size(), 0);
}

TEST(DetectionPacket, HoldsEveryFieldOfARobot) {
  Detections found;
  found.robots = {robot(Team::kBlue, 0), robot(Team::kYellow, 7)};
  const SSL_DetectionFrame frame = only_frame(found, {.robot_height_mm = 75.0});
  ASSERT_EQ(frame.robots_blue_size(), 1);
  ASSERT_EQ(frame.robots_yellow_size(), 1);
  EXPECT_TRUE(frame.robots_blue(0).has_robot_id());
  EXPECT_EQ(frame.robots_blue(0).robot_id(), 0U);
  const SSL_DetectionRobot& yellow = frame.robots_yellow(0);
  EXPECT_EQ(yellow.robot_id(), 7U);
  EXPECT_EQ(yellow.confidence(), 0.75F);
  EXPECT_EQ(yellow.x(), 107.5F);
  EXPECT_EQ(yellow.y(), -20.25F);
  EXPECT_EQ(yellow.orientation(), -1.5F);
  EXPECT_EQ(yellow.pixel_x(), 320.5F);
  EXPECT_EQ(yellow.pixel_y(), 200.25F);
  EXPECT_EQ(yellow.height(), 75.0F);
}

TEST(DetectionPacket, HoldsEveryFieldOfTheBall) {
  Detections found;
  found.ball = BallDetection{};
  found.ball->position_mm = {-1.5, 2.5};
  found.ball->centroid_px = {10.5, 20.25};
  found.ball->area_px = 41.6;
  found.ball->confidence = 0.5;
  const SSL_DetectionFrame frame = only_frame(found);
  ASSERT_EQ(frame.balls_size(), 1);
  const SSL_DetectionBall& ball = frame.balls(0);
  EXPECT_EQ(ball.confidence(), 0.5F);
  EXPECT_EQ(ball.area(), 42U);
  EXPECT_EQ(ball.x(), -1.5F);
  EXPECT_EQ(ball.y(), 2.5F);
  EXPECT_EQ(ball.z(), 0.0F);
  EXPECT_EQ(ball.pixel_x(), 10.5F);
  EXPECT_EQ(ball.pixel_y(), 20.25F);
}

TEST(DetectionPacket, LeavesOutWhatWasNotSeen) {
  Detections found;
  found.ball = BallDetection{};
  found.ball->state = TrackState::kPredicted;
  found.robots = {robot(Team::kBlue, 1), robot(Team::kBlue, 2)};
  found.robots[0].state = TrackState::kPredicted;
  const SSL_DetectionFrame frame = only_frame(found);
  EXPECT_EQ(frame.balls_size(), 0);
  ASSERT_EQ(frame.robots_blue_size(), 1);
  EXPECT_EQ(frame.robots_blue(0).robot_id(), 2U);
}

TEST(DetectionPacket, HoldsRobotsWithoutAnIdOnlyWhereAskedTo) {
  Detections found;
  found.robots = {robot(Team::kYellow, kUnknownId)};
  EXPECT_EQ(only_frame(found).robots_yellow_size(), 0);
  const SSL_DetectionFrame frame = only_frame(found, {.unknown_ids = true});
  ASSERT_EQ(frame.robots_yellow_size(), 1);
  EXPECT_FALSE(frame.robots_yellow(0).has_robot_id());
}

TEST(DetectionPacket, OfAFullMatchIsOne) {
  Detections found;
  found.ball = BallDetection{};
  for (int id = 0; id < 11; ++id) found.robots.push_back(robot(Team::kBlue, id));
  for (int id = 0; id < 11; ++id) found.robots.push_back(robot(Team::kYellow, id));
  EXPECT_THAT(detection_packets(found, {}), SizeIs(1));
}

RC_GTEST_PROP(DetectionPackets, ShareOutAnyNumberOfRobotsInOrder, ()) {
  Detections found;
  found.sequence = *rc::gen::arbitrary<std::uint32_t>();
  found.ball = BallDetection{};
  std::vector<std::uint32_t> blue;
  std::vector<std::uint32_t> yellow;
  for (auto* ids : {&blue, &yellow}) {
    const auto count = *rc::gen::inRange<std::uint32_t>(0, 130);
    for (std::uint32_t id = 0; id < count; ++id) {
      ids->push_back(*rc::gen::inRange<std::uint32_t>(0, 1'000'000));  // 1 to 3 bytes long
      found.robots.push_back(
          robot(ids == &blue ? Team::kBlue : Team::kYellow, static_cast<int>(ids->back())));
    }
  }

  std::vector<std::uint32_t> blue_sent;
  std::vector<std::uint32_t> yellow_sent;
  const std::vector<std::string> packets = detection_packets(found, {.t_sent_s = 1.5});
  for (std::size_t i = 0; i < packets.size(); ++i) {
    RC_ASSERT(packets[i].size() <= kMaxPacketBytes);
    const SSL_DetectionFrame frame = parsed(packets[i]).detection();
    RC_ASSERT(frame.frame_number() == found.sequence);
    RC_ASSERT(frame.t_sent() == 1.5);
    RC_ASSERT(frame.balls_size() == (i == 0 ? 1 : 0));
    for (const auto& sent : frame.robots_blue()) blue_sent.push_back(sent.robot_id());
    for (const auto& sent : frame.robots_yellow()) yellow_sent.push_back(sent.robot_id());
    // Nothing is gained by more packets than it takes.
    if (i + 1 < packets.size()) RC_ASSERT(packets[i].size() + 45 > kMaxPacketBytes);
  }
  RC_ASSERT(blue_sent == blue);
  RC_ASSERT(yellow_sent == yellow);
}

}  // namespace
}  // namespace maggic::ssl_vision
