#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "maggic/field.hpp"
#include "maggic/sink.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

class LabelledImages : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  StagePtr<Sink> sink(std::string_view rest = "") const {
    StagePtr<Sink> made = testing::make<Sink>(
        "labelled_images", fmt::format("path: '{}'\n{}", (folder_ / "set").string(), rest));
    made->open({testing::standard_palette(), {false, 5, 60.0}});
    return made;
  }

  /// Blue over red, the robot facing up in the picture; an orange ball.
  static FrameResult sample(std::uint64_t sequence) {
    FrameResult result;
    result.frame.sequence = sequence;
    result.frame.bgr = cv::Mat(24, 32, CV_8UC3, cv::Scalar(10, 20, 30));
    result.frame.truth_labels = cv::Mat::zeros(24, 32, CV_8UC1);
    result.frame.truth_labels.at<Label>(7, 9) = 4;
    result.frame.has_truth = true;
    BallDetection& ball = result.frame.truth.ball.emplace();
    ball.centroid_px = {20.5, 3.25};
    ball.position_mm = {100.0, -50.0};
    RobotDetection robot;
    robot.id = 2;
    robot.player_colors = {*testing::standard_palette().find("red")};
    robot.position_mm = {-12.5, 34.0};
    robot.heading_rad = 1.5;
    robot.tags = {{*testing::standard_palette().find("blue"), {10.0, 8.0}, 40.0},
                  {*testing::standard_palette().find("red"), {10.0, 12.0}, 40.0}};
    result.frame.truth.robots.push_back(robot);
    return result;
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "set")) {
      names.insert(entry.path().filename());
    }
    return names;
  }

  const Field field_{FieldParameters{}, cv::Size(32, 24)};
  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("maggic_labelled_images_{}", ::getpid());
};

TEST_F(LabelledImages, KeepsTheContractOfSinks) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSink, "labelled_images",
                                         fmt::format("path: '{}'", (folder_ / "set").string())),
              IsEmpty());
}

TEST_F(LabelledImages, WritesPictureAndLabelsAsTheyAre) {
  const auto written = sink();
  const FrameResult result = sample(7);
  written->write(result, field_);
  written->close();
  const cv::Mat picture = cv::imread((folder_ / "set/000007.png").string(), cv::IMREAD_UNCHANGED);
  const cv::Mat labels =
      cv::imread((folder_ / "set/000007.labels.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(picture, result.frame.bgr, cv::NORM_INF), 0.0);
  ASSERT_EQ(labels.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(labels, result.frame.truth_labels, cv::NORM_INF), 0.0);
}

TEST_F(LabelledImages, AnnotatesInPixelsAndMillimetres) {
  const auto written = sink();
  written->write(sample(0), field_);
  written->close();
  std::ifstream stream(folder_ / "set/000000.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  EXPECT_EQ(json.at("media"), "000000.png");
  EXPECT_EQ(json.at("size_px"), nlohmann::json({32, 24}));
  EXPECT_EQ(json.at("ball"),
            nlohmann::json({{"x", 20.5}, {"y", 3.25}, {"x_mm", 100.0}, {"y_mm", -50.0}}));
  const nlohmann::json& robot = json.at("robots").at(0);
  EXPECT_EQ(robot.at("x"), 10.0);
  EXPECT_EQ(robot.at("y"), 10.0);
  EXPECT_EQ(robot.at("heading_deg"), 90.0);
  EXPECT_EQ(robot.at("id"), 2);
  EXPECT_EQ(robot.at("x_mm"), -12.5);
  EXPECT_EQ(robot.at("heading_rad"), 1.5);
  EXPECT_EQ(robot.at("tags").at(1).at("color"), "red");
  EXPECT_EQ(json.at("labels").at(4), "red");
}

TEST_F(LabelledImages, WritesEveryNthFrame) {
  const auto written = sink("every: 3");
  for (const std::uint64_t sequence : {0, 1, 2, 3, 4}) written->write(sample(sequence), field_);
  written->close();
  EXPECT_THAT(files(), UnorderedElementsAre("000000.png", "000000.labels.png", "000000.json",
                                            "000003.png", "000003.labels.png", "000003.json"));
}

TEST_F(LabelledImages, SaysSoWhenNoFrameHasLabels) {
  const auto written = sink();
  FrameResult result = sample(0);
  result.frame.truth_labels.release();
  written->write(result, field_);
  EXPECT_THAT([&] { written->close(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("labels: true")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(LabelledImages, LeavesNoPartOfASampleItCannotComplete) {
  const auto written = sink();
  // Where the annotation should go lies a folder: it cannot be replaced.
  fs::create_directories(folder_ / "set/000000.json/occupied");
  EXPECT_THROW(written->write(sample(0), field_), std::runtime_error);
  EXPECT_THAT(files(), UnorderedElementsAre("000000.json"));
}

TEST_F(LabelledImages, RefusesAFolderItCannotMake) {
  const auto made =
      testing::make<Sink>("labelled_images", fmt::format("path: '{}'", (folder_ / "a/b").string()));
  EXPECT_THAT(
      [&] {
        made->open({testing::standard_palette(), {}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("a/b")));
}

}  // namespace
}  // namespace maggic
