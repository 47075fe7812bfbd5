/// What the network sinks send, read by programs that share nothing with them: a client written in
/// Python, and protoc.

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "maggic/testing.hpp"
#include "network/udp_receiver_for_tests.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

using nlohmann::json;
using testing::Folder;
using ::testing::HasSubstr;
using testing::Program;
using testing::ProgramResult;

const std::string kSinks = std::string(MAGGIC_SOURCE_DIR) + "/plugins/sinks/";

bool can_be_started(const Folder& folder, const std::string& program) {
  return Program(folder.path(), program, {"--version"}).wait().exit_code == 0;
}

std::vector<json> json_lines(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

/// What the Python client heard of a run of maggic, and what the run's log says.
class PythonClient : public ::testing::Test {
 protected:
  static constexpr int kFrames = 20;

  void SetUp() override {
    if (!can_be_started(client_folder_, "python3")) GTEST_SKIP() << "there is no python3 here";
  }

  /// Lets maggic watch a synthetic match with a client listening to `sink`.
  void run(const std::string& sink, int packets) {
    Program client(client_folder_.path(), "python3",
                   {kSinks + "network/listen.py", sink, "--address", "127.0.0.1", "--port", "0",
                    "--count", std::to_string(packets), "--timeout", "60"});
    const std::string port = port_of(client);
    const std::string log = folder_.file("log.jsonl");
    const std::string pipeline = folder_.write(
        "pipeline.yaml",
        fmt::format("source: {{synthetic_match: {{}}}}\nsegmenter: hue_pivots\ntracker: two_tag\n"
                    "sinks:\n  - {}: {{address: 127.0.0.1, port: {}}}\n  - jsonl: {{path: '{}'}}\n",
                    sink, port, log));
    const ProgramResult maggic =
        Program(folder_.path(), {"run", pipeline, "--frames", std::to_string(kFrames)}).wait();
    ASSERT_EQ(maggic.exit_code, 0) << maggic.err;
    const ProgramResult heard = client.wait();
    ASSERT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_THAT(heard.err, ::testing::Not(HasSubstr("cannot be read")));
    packets_ = json_lines(heard.out);
    frames_ = json_lines(testing::text_of(log));
    ASSERT_EQ(packets_.size(), static_cast<std::size_t>(packets));
    ASSERT_EQ(frames_.size(), static_cast<std::size_t>(kFrames));
  }

  Folder folder_;
  Folder client_folder_;
  std::vector<json> packets_;
  std::vector<json> frames_;

 private:
  static std::string port_of(const Program& client) {
    const std::string before = "listening at 127.0.0.1:";
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < give_up) {
      const std::string said = client.err();
      if (said.starts_with(before) && said.back() == '\n') {
        return said.substr(before.size(), said.size() - before.size() - 1);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    throw std::runtime_error("the client does not listen: " + client.err());
  }
};

/// Whether a packet's object has the log's values, in the packet's unit and precision.
void expect_same(const json& sent, const json& logged, const char* sent_key, const char* log_key,
                 double scale) {
  ASSERT_TRUE(sent.contains(sent_key)) << sent;
  EXPECT_NEAR(sent[sent_key].get<double>(), logged[log_key].get<double>() * scale,
              1e-3 * scale + 1e-6 * std::abs(sent[sent_key].get<double>()))
      << sent_key;
}

/// The log's robots of a team with an id, in order.
std::vector<json> robots_of(const json& frame, const std::string& team) {
  std::vector<json> robots;
  for (const json& robot : frame["robots"]) {
    if (robot["team"] == team && robot["id"] >= 0) robots.push_back(robot);
  }
  return robots;
}

TEST_F(PythonClient, ReadsSslVisionAsItWasLogged) {
  ASSERT_NO_FATAL_FAILURE(run("ssl_vision", kFrames + 1));
  EXPECT_EQ(packets_[0]["geometry"]["field"]["field_length"], 1500);
  EXPECT_EQ(packets_[0]["geometry"]["field"]["field_lines"].size(), 11U);
  for (int i = 0; i < kFrames; ++i) {
    const json& logged = frames_[i];
    const json& sent = packets_[i + 1]["detection"];
    EXPECT_EQ(sent["frame_number"], logged["frame"]);
    EXPECT_DOUBLE_EQ(sent["t_capture"].get<double>(), logged["t_capture"].get<double>());
    EXPECT_GT(sent["t_sent"], sent["t_capture"]);
    ASSERT_EQ(sent["balls"].size(), 1U);
    expect_same(sent["balls"][0], logged["ball"], "x", "x_mm", 1.0);
    expect_same(sent["balls"][0], logged["ball"], "pixel_x", "x_px", 1.0);
    for (const std::string team : {"blue", "yellow"}) {
      const std::vector<json> robots = robots_of(logged, team);
      const json& robots_sent = sent["robots_" + team];
      ASSERT_EQ(robots_sent.size(), robots.size());
      ASSERT_EQ(robots.size(), 3U);
      for (std::size_t k = 0; k < robots.size(); ++k) {
        EXPECT_EQ(robots_sent[k]["robot_id"], robots[k]["id"]);
        expect_same(robots_sent[k], robots[k], "x", "x_mm", 1.0);
        expect_same(robots_sent[k], robots[k], "y", "y_mm", 1.0);
        expect_same(robots_sent[k], robots[k], "orientation", "heading_rad", 1.0);
        expect_same(robots_sent[k], robots[k], "pixel_y", "y_px", 1.0);
        expect_same(robots_sent[k], robots[k], "confidence", "confidence", 1.0);
      }
    }
  }
}

TEST_F(PythonClient, ReadsSslTrackedAsItWasLogged) {
  ASSERT_NO_FATAL_FAILURE(run("ssl_tracked", kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const json& logged = frames_[i];
    const json& sent = packets_[i]["tracked_frame"];
    EXPECT_EQ(packets_[i]["uuid"], packets_[0]["uuid"]);
    EXPECT_EQ(sent["frame_number"], logged["frame"]);
    expect_same(sent["balls"][0]["pos"], logged["ball"], "y", "y_mm", 1e-3);
    expect_same(sent["balls"][0]["vel"], logged["ball"], "x", "vx_mm_s", 1e-3);
    ASSERT_EQ(sent["robots"].size(), logged["robots"].size());
    for (std::size_t k = 0; k < logged["robots"].size(); ++k) {
      const json& robot = sent["robots"][k];
      EXPECT_EQ(robot["robot_id"]["id"], logged["robots"][k]["id"]);
      EXPECT_EQ(robot["robot_id"]["team_color"], logged["robots"][k]["team"] == "blue" ? 2 : 1);
      expect_same(robot["pos"], logged["robots"][k], "x", "x_mm", 1e-3);
      expect_same(robot["vel"], logged["robots"][k], "y", "vy_mm_s", 1e-3);
      expect_same(robot, logged["robots"][k], "visibility", "confidence", 1.0);
    }
  }
}

TEST_F(PythonClient, ReadsFiraAsItWasLogged) {
  ASSERT_NO_FATAL_FAILURE(run("fira", kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const json& logged = frames_[i];
    const json& sent = packets_[i];
    EXPECT_EQ(sent.value("step", 0), logged["frame"]);  // 0 is not written
    EXPECT_DOUBLE_EQ(sent["field"]["length"].get<double>(), 1.5);
    expect_same(sent["frame"]["ball"], logged["ball"], "x", "x_mm", 1e-3);
    for (const std::string team : {"blue", "yellow"}) {
      const std::vector<json> robots = robots_of(logged, team);
      const json& robots_sent = sent["frame"]["robots_" + team];
      ASSERT_EQ(robots_sent.size(), robots.size());
      for (std::size_t k = 0; k < robots.size(); ++k) {
        EXPECT_EQ(robots_sent[k].value("robot_id", 0), robots[k]["id"]);
        expect_same(robots_sent[k], robots[k], "y", "y_mm", 1e-3);
        expect_same(robots_sent[k], robots[k], "orientation", "heading_rad", 1.0);
      }
    }
  }
}

/// One frame with a ball and a yellow robot, in numbers that every precision holds exactly.
FrameResult example_frame() {
  FrameResult result;
  result.detections.sequence = 12;
  result.detections.captured = std::chrono::milliseconds(500);
  BallDetection& ball = result.detections.ball.emplace();
  ball.position_mm = {250.0, -125.0};
  ball.centroid_px = {10.5, 20.25};
  ball.area_px = 42.0;
  ball.confidence = 0.5;
  RobotDetection& robot = result.detections.robots.emplace_back();
  robot.team = Team::kYellow;
  robot.id = 3;
  robot.position_mm = {-500.0, 125.0};
  robot.heading_rad = 0.5;
  robot.velocity_mm_s = {1000.0, -2000.0};
  robot.angular_velocity_rad_s = -3.0;
  robot.centroid_px = {320.25, 200.5};
  robot.confidence = 0.75;
  return result;
}

struct Decoding {
  std::string sink;
  std::string message;
  std::string text;  ///< What protoc must print for the example frame, somewhere.
};

void PrintTo(const Decoding& decoding, std::ostream* stream) { *stream << decoding.sink; }

class DecodedByProtoc : public ::testing::TestWithParam<Decoding> {};

TEST_P(DecodedByProtoc, IsTheExampleFrame) {
  const Folder folder;
  if (!can_be_started(folder, "protoc")) GTEST_SKIP() << "there is no protoc here";
  network::UdpReceiver client;
  const auto sink = testing::make<Sink>(GetParam().sink, client.parameters());
  sink->open({testing::standard_palette(), {}});
  sink->write(example_frame(), Field(FieldParameters{}, cv::Size(640, 480)));
  std::string decoded;
  while (!client.is_empty()) {
    const std::string packet = folder.write("packet", client.receive());
    const ProgramResult protoc =
        Program(folder.path(), "/bin/sh",
                {"-c", "exec protoc \"$1\" -I \"$2\" \"$3\" < \"$4\"", "sh",
                 "--decode=" + GetParam().message, kSinks + GetParam().sink,
                 GetParam().sink + ".proto", packet})
            .wait();
    ASSERT_EQ(protoc.exit_code, 0) << protoc.err;
    decoded += protoc.out;
  }
  EXPECT_THAT(decoded, HasSubstr(GetParam().text));
}

INSTANTIATE_TEST_SUITE_P(Sinks, DecodedByProtoc,
                         ::testing::Values(Decoding{"ssl_vision", "SSL_WrapperPacket",
                                                    R"(detection {
  frame_number: 12
  t_capture: 0.5
  t_sent: 0.5
  camera_id: 0
  balls {
    confidence: 0.5
    area: 42
    x: 250
    y: -125
    z: 0
    pixel_x: 10.5
    pixel_y: 20.25
  }
  robots_yellow {
    confidence: 0.75
    robot_id: 3
    x: -500
    y: 125
    orientation: 0.5
    pixel_x: 320.25
    pixel_y: 200.5
    height: 75
  }
}
)"},
                                           Decoding{"ssl_tracked", "TrackerWrapperPacket",
                                                    R"(source_name: "maggic"
tracked_frame {
  frame_number: 12
  timestamp: 0.5
  balls {
    pos {
      x: 0.25
      y: -0.125
      z: 0
    }
    vel {
      x: 0
      y: 0
      z: 0
    }
    visibility: 0.5
  }
  robots {
    robot_id {
      id: 3
      team_color: TEAM_COLOR_YELLOW
    }
    pos {
      x: -0.5
      y: 0.125
    }
    orientation: 0.5
    vel {
      x: 1
      y: -2
    }
    vel_angular: -3
    visibility: 0.75
  }
}
)"},
                                           Decoding{"fira", "fira_message.Environment",
                                                    R"(step: 12
frame {
  ball {
    x: 0.25
    y: -0.125
    z: 0.02135
  }
  robots_yellow {
    robot_id: 3
    x: -0.5
    y: 0.125
    orientation: 0.5
    vx: 1
    vy: -2
    vorientation: -3
  }
}
)"}),
                         [](const auto& test) { return test.param.sink; });

}  // namespace
}  // namespace maggic
