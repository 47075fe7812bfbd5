#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "maggic/config_error.hpp"
#include "maggic/testing.hpp"

namespace {

using maggic::testing::standard_palette;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class JsonlSink : public ::testing::Test {
 protected:
  JsonlSink() { std::filesystem::create_directories(folder_); }
  ~JsonlSink() override { std::filesystem::remove_all(folder_); }

  maggic::StagePtr<maggic::Sink> sink_to(const std::string& path) {
    return maggic::testing::make<maggic::Sink>("jsonl", "path: '" + path + "'");
  }

  std::vector<std::string> lines_of(const std::string& path) {
    std::vector<std::string> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  maggic::FrameResult example_frame() {
    maggic::FrameResult result;
    result.detections.sequence = 12;
    result.detections.captured = std::chrono::milliseconds(400);
    maggic::RobotDetection robot;
    robot.team = maggic::Team::kYellow;
    robot.id = 3;
    robot.player_colors = {*standard_palette().find("green"), *standard_palette().find("cyan")};
    robot.position_mm = {100.12345, -20.0};
    robot.heading_rad = 0.5;
    robot.velocity_mm_s = {1.0, 2.0};
    robot.angular_velocity_rad_s = -3.0;
    robot.centroid_px = {320.25, 200.5};
    robot.confidence = 0.75;
    robot.state = maggic::TrackState::kPredicted;
    result.detections.robots.push_back(robot);
    return result;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("jsonl_test_" + std::to_string(::getpid()));
  const std::string path_ = folder_ / "out.jsonl";
  const maggic::RunInfo info_{standard_palette(), {}};
  const maggic::Field field_{maggic::FieldParameters{}, cv::Size(640, 480)};
};

TEST_F(JsonlSink, KeepsTheSinkContract) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSink, "jsonl",
                                                 "path: '" + path_ + "'"),
              IsEmpty());
}

TEST_F(JsonlSink, WritesEveryFieldOfARobot) {
  auto sink = sink_to(path_);
  sink->open(info_);
  sink->write(example_frame(), field_);
  sink->close();
  EXPECT_THAT(
      lines_of(path_),
      ElementsAre(R"({"frame":12,"t_capture":0.4,"ball":null,"robots":[{"team":"yellow","id":3,)"
                  R"("player_colors":["green","cyan"],"x_mm":100.123,"y_mm":-20.0,)"
                  R"("heading_rad":0.5,"vx_mm_s":1.0,"vy_mm_s":2.0,"omega_rad_s":-3.0,)"
                  R"("x_px":320.25,"y_px":200.5,"confidence":0.75,"state":"predicted"}]})"));
}

TEST_F(JsonlSink, WritesEveryFieldOfTheBall) {
  maggic::FrameResult result;
  result.detections.ball = maggic::BallDetection{};
  result.detections.ball->position_mm = {1.5, -2.5};
  result.detections.ball->confidence = 1.0;
  auto sink = sink_to(path_);
  sink->open(info_);
  sink->write(result, field_);
  sink->close();
  const auto ball = nlohmann::json::parse(lines_of(path_).at(0)).at("ball");
  EXPECT_EQ(ball, (nlohmann::json{{"x_mm", 1.5},
                                  {"y_mm", -2.5},
                                  {"vx_mm_s", 0.0},
                                  {"vy_mm_s", 0.0},
                                  {"x_px", 0.0},
                                  {"y_px", 0.0},
                                  {"confidence", 1.0},
                                  {"state", "seen"}}));
}

TEST_F(JsonlSink, LeavesEveryLineInTheFileBeforeItIsClosed) {
  auto sink = sink_to(path_);
  sink->open(info_);
  for (std::size_t count = 1; count <= 3; ++count) {
    sink->write(example_frame(), field_);
    EXPECT_EQ(lines_of(path_).size(), count);
  }
}

TEST_F(JsonlSink, NamesTheFolderThatDoesNotExist) {
  auto sink = sink_to(folder_ / "nowhere" / "out.jsonl");
  EXPECT_THAT([&] { sink->open(info_); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("folder " + (folder_ / "nowhere").string() + " does not exist")));
}

TEST_F(JsonlSink, RefusesAFolderAsItsFile) {
  auto sink = sink_to(folder_);
  EXPECT_THAT([&] { sink->open(info_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("Is a directory")));
}

TEST_F(JsonlSink, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  auto sink = sink_to("/dev/full");
  sink->open(info_);
  EXPECT_THAT([&] { sink->write(example_frame(), field_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("No space left on device")));
}

TEST_F(JsonlSink, NeedsAPath) {
  EXPECT_THROW(maggic::testing::make<maggic::Sink>("jsonl"), maggic::ConfigError);
  EXPECT_THROW(maggic::testing::make<maggic::Sink>("jsonl", "path: ''"), maggic::ConfigError);
}

}  // namespace
