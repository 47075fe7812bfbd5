#include <chrono>
#include <string>

#include <gmock/gmock.h>

#include "maggic/testing.hpp"
#include "network/robot_for_tests.hpp"
#include "network/udp_receiver_for_tests.hpp"
#include "ssl_tracked.pb.h"

namespace {

using maggic::network::robot;
using maggic::testing::standard_palette;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

class SslTrackedSink : public ::testing::Test {
 protected:
  maggic::StagePtr<maggic::Sink> sink(const std::string& more = "") {
    auto sink = maggic::testing::make<maggic::Sink>("ssl_tracked", client_.parameters(more));
    sink->open(info_);
    return sink;
  }

  TrackerWrapperPacket sent(maggic::Sink& sink, const maggic::FrameResult& result) {
    sink.write(result, field_);
    TrackerWrapperPacket packet;
    EXPECT_TRUE(packet.ParseFromString(client_.receive()));
    EXPECT_TRUE(client_.is_empty());
    return packet;
  }

  maggic::network::UdpReceiver client_;
  const maggic::RunInfo info_{standard_palette(), {}};
  const maggic::Field field_{maggic::FieldParameters{}, cv::Size(640, 480)};
};

TEST_F(SslTrackedSink, KeepsTheSinkContract) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSink, "ssl_tracked",
                                                 client_.parameters()),
              IsEmpty());
}

TEST_F(SslTrackedSink, SendsRobotsInMetresPredictedOnesToo) {
  maggic::FrameResult result;
  result.detections.sequence = 12;
  result.detections.captured = std::chrono::milliseconds(1500);
  result.detections.robots = {robot(maggic::Team::kBlue, 2, maggic::TrackState::kSeen),
                              robot(maggic::Team::kYellow, 0, maggic::TrackState::kPredicted)};
  const TrackedFrame frame = sent(*sink(), result).tracked_frame();
  EXPECT_EQ(frame.frame_number(), 12U);
  EXPECT_DOUBLE_EQ(frame.timestamp(), 1.5);
  EXPECT_EQ(frame.balls_size(), 0);
  ASSERT_EQ(frame.robots_size(), 2);
  const TrackedRobot& seen = frame.robots(0);
  EXPECT_EQ(seen.robot_id().id(), 2U);
  EXPECT_EQ(seen.robot_id().team_color(), TEAM_COLOR_BLUE);
  EXPECT_EQ(seen.pos().x(), 0.5F);
  EXPECT_EQ(seen.pos().y(), -0.25F);
  EXPECT_EQ(seen.orientation(), 0.5F);
  EXPECT_EQ(seen.vel().x(), 1.0F);
  EXPECT_EQ(seen.vel().y(), -2.0F);
  EXPECT_EQ(seen.vel_angular(), -3.0F);
  EXPECT_EQ(seen.visibility(), 1.0F);
  EXPECT_EQ(frame.robots(1).robot_id().team_color(), TEAM_COLOR_YELLOW);
  EXPECT_EQ(frame.robots(1).visibility(), 0.25F);
}

TEST_F(SslTrackedSink, SendsTheBallInMetres) {
  maggic::FrameResult result;
  result.detections.ball = maggic::BallDetection{};
  result.detections.ball->position_mm = {-250.0, 125.0};
  result.detections.ball->velocity_mm_s = {500.0, 0.0};
  result.detections.ball->confidence = 0.5;
  const TrackedFrame frame = sent(*sink(), result).tracked_frame();
  ASSERT_EQ(frame.balls_size(), 1);
  EXPECT_EQ(frame.balls(0).pos().x(), -0.25F);
  EXPECT_EQ(frame.balls(0).pos().y(), 0.125F);
  EXPECT_EQ(frame.balls(0).pos().z(), 0.0F);
  EXPECT_EQ(frame.balls(0).vel().x(), 0.5F);
  EXPECT_EQ(frame.balls(0).visibility(), 0.5F);
}

TEST_F(SslTrackedSink, LeavesOutRobotsWithoutAnId) {
  maggic::FrameResult result;
  result.detections.robots = {
      robot(maggic::Team::kBlue, maggic::kUnknownId, maggic::TrackState::kSeen)};
  EXPECT_EQ(sent(*sink(), result).tracked_frame().robots_size(), 0);
}

TEST_F(SslTrackedSink, NamesItselfTheSameAllRunLongAndAnotherNextTime) {
  const auto first = sink(", source_name: north camera");
  const TrackerWrapperPacket packet = sent(*first, {});
  EXPECT_THAT(packet.uuid(), MatchesRegex("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-"
                                          "[0-9a-f]{12}"));
  EXPECT_EQ(packet.source_name(), "north camera");
  EXPECT_EQ(sent(*first, {}).uuid(), packet.uuid());
  EXPECT_NE(sent(*sink(), {}).uuid(), packet.uuid());
}

}  // namespace
