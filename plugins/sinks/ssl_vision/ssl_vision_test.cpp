#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "maggic/config_error.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"
#include "network/udp_receiver_for_tests.hpp"
#include "ssl_vision.pb.h"

namespace {

using maggic::testing::standard_palette;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class SslVisionSink : public ::testing::Test {
 protected:
  /// A sink that sends to `client_`.
  maggic::StagePtr<maggic::Stage> sink(const std::string& more = "") {
    auto stage = maggic::testing::registry().create(maggic::StageKind::kSink, "ssl_vision");
    maggic::configure_stage(*stage, client_.parameters(more), standard_palette(), reporter_);
    return stage;
  }
  static maggic::Sink& as_sink(const maggic::StagePtr<maggic::Stage>& stage) {
    return static_cast<maggic::Sink&>(*stage);
  }

  SSL_WrapperPacket receive() {
    SSL_WrapperPacket packet;
    EXPECT_TRUE(packet.ParseFromString(client_.receive()));
    return packet;
  }

  static maggic::FrameResult frame_at(std::chrono::nanoseconds captured) {
    maggic::FrameResult result;
    result.detections.captured = captured;
    maggic::RobotDetection robot;
    robot.id = 4;
    robot.confidence = 1.0;
    result.detections.robots.push_back(robot);
    result.times[maggic::Step::kSegment] = milliseconds(2);
    return result;
  }

  maggic::network::UdpReceiver client_;
  maggic::testing::RecordingReporter reporter_;
  const maggic::RunInfo recorded_{standard_palette(), {}};
  const maggic::RunInfo live_{standard_palette(), {.live = true}};
  const maggic::Field field_{maggic::FieldParameters{}, cv::Size(640, 480)};
};

TEST_F(SslVisionSink, KeepsTheSinkContract) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSink, "ssl_vision",
                                                 client_.parameters()),
              IsEmpty());
}

TEST_F(SslVisionSink, SendsTheFieldFirstAndThenOnceASecond) {
  const auto stage = sink();
  as_sink(stage).open(recorded_);
  std::vector<int> geometry_at_ms;
  for (int at_ms = 0; at_ms <= 2500; at_ms += 100) {
    as_sink(stage).write(frame_at(milliseconds(at_ms)), field_);
    SSL_WrapperPacket packet = receive();
    if (packet.has_geometry()) {
      EXPECT_FALSE(packet.has_detection()) << "the field comes in a packet of its own";
      geometry_at_ms.push_back(at_ms);
      packet = receive();
    }
    EXPECT_EQ(packet.detection().robots_blue_size(), 1);
    EXPECT_TRUE(client_.is_empty());
  }
  EXPECT_THAT(geometry_at_ms, ElementsAre(0, 1000, 2000));
}

TEST_F(SslVisionSink, SendsTheFieldAgainWhenTheClockWentBack) {
  const auto stage = sink();
  as_sink(stage).open(recorded_);
  as_sink(stage).write(frame_at(std::chrono::hours(1)), field_);
  EXPECT_TRUE(receive().has_geometry());
  EXPECT_TRUE(receive().has_detection());
  as_sink(stage).write(frame_at(milliseconds(0)), field_);
  EXPECT_TRUE(receive().has_geometry());
}

TEST_F(SslVisionSink, TellsRecordedFramesByTheirOwnTime) {
  const auto stage = sink();
  as_sink(stage).open(recorded_);
  as_sink(stage).write(frame_at(milliseconds(1500)), field_);
  receive();
  const SSL_DetectionFrame frame = receive().detection();
  EXPECT_DOUBLE_EQ(frame.t_capture(), 1.5);
  EXPECT_DOUBLE_EQ(frame.t_sent(), 1.502);
}

TEST_F(SslVisionSink, TellsLiveFramesInUnixTime) {
  const auto stage = sink();
  as_sink(stage).open(live_);
  const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
  as_sink(stage).write(frame_at(now), field_);
  receive();
  const SSL_DetectionFrame frame = receive().detection();
  EXPECT_DOUBLE_EQ(frame.t_capture(), std::chrono::duration<double>(now).count());
  EXPECT_GE(frame.t_sent(), frame.t_capture());
  EXPECT_LT(frame.t_sent(), frame.t_capture() + 10.0);
}

TEST_F(SslVisionSink, SendsWhatTheFileSays) {
  const auto stage = sink(", camera_id: 2, markings: {goal_width_mm: 450}");
  as_sink(stage).open(recorded_);
  as_sink(stage).write(frame_at(milliseconds(0)), field_);
  EXPECT_EQ(receive().geometry().field().goal_width(), 450);
  EXPECT_EQ(receive().detection().camera_id(), 2U);
}

TEST_F(SslVisionSink, WarnsOnceOfAMissingInterfaceAndGoesOn) {
  const auto stage = sink(", interface: no_such_card");
  as_sink(stage).open(recorded_);
  for (int i = 0; i < 10; ++i) as_sink(stage).write(frame_at(milliseconds(10 * i)), field_);
  as_sink(stage).close();
  EXPECT_THAT(reporter_.messages(),
              ElementsAre(HasSubstr("there is no network interface 'no_such_card'")));
  EXPECT_TRUE(client_.is_empty());
}

TEST_F(SslVisionSink, SaysWhereAnAddressIsNone) {
  EXPECT_THAT([] { maggic::testing::make<maggic::Sink>("ssl_vision", "address: 224.5.23"); },
              ThrowsMessage<maggic::ConfigError>(
                  AllOf(StartsWith("parameters:1:10: "),
                        HasSubstr("found '224.5.23', expected an IPv4 address"))));
}

}  // namespace
