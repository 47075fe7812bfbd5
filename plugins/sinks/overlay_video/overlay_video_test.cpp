#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "maggic/config_error.hpp"
#include "maggic/testing.hpp"

namespace {

using maggic::testing::standard_palette;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class OverlayVideoSink : public ::testing::Test {
 protected:
  OverlayVideoSink() { std::filesystem::create_directories(folder_); }
  ~OverlayVideoSink() override { std::filesystem::remove_all(folder_); }

  maggic::StagePtr<maggic::Sink> sink_to(const std::string& path, const std::string& more = "") {
    return maggic::testing::make<maggic::Sink>("overlay_video",
                                               "{path: '" + path + "', codec: mp4v" + more + "}");
  }

  void write_frame(maggic::Sink& sink, cv::Size size) {
    maggic::FrameResult result;
    result.frame.bgr = cv::Mat(size, CV_8UC3, cv::Scalar(40, 90, 40));
    sink.write(result, maggic::Field(maggic::FieldParameters{}, size));
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("overlay_test_" + std::to_string(::getpid()));
  const std::string path_ = folder_ / "overlay.mp4";
  const maggic::RunInfo info_{standard_palette(), {}};
};

TEST_F(OverlayVideoSink, KeepsTheSinkContract) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSink, "overlay_video",
                                                 "{path: '" + path_ + "', codec: mp4v}"),
              IsEmpty());
}

TEST_F(OverlayVideoSink, WritesAPlayableVideoOfEveryFrame) {
  auto sink = sink_to(path_, ", frames_per_second: 25");
  sink->open(info_);
  for (int i = 0; i < 5; ++i) write_frame(*sink, {160, 120});
  sink->close();
  cv::VideoCapture video(path_);
  ASSERT_TRUE(video.isOpened());
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_COUNT), 5);
  EXPECT_EQ(video.get(cv::CAP_PROP_FPS), 25);
}

TEST_F(OverlayVideoSink, EnlargesSmallPicturesAndOnlyThose) {
  for (const auto& [frame, drawn] : {std::pair(cv::Size(320, 240), cv::Size(640, 480)),
                                     std::pair(cv::Size(960, 240), cv::Size(960, 240))}) {
    auto sink = sink_to(path_, ", caption: false");
    sink->open(info_);
    write_frame(*sink, frame);
    sink->close();
    cv::VideoCapture video(path_);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), drawn.width);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), drawn.height);
  }
}

TEST_F(OverlayVideoSink, FitsFramesOfAnotherSizeIntoTheFirstOnes) {
  auto sink = sink_to(path_, ", caption: false, field_lines: false, scale: 1");
  sink->open(info_);
  write_frame(*sink, {160, 120});
  write_frame(*sink, {60, 120});
  write_frame(*sink, {161, 33});
  sink->close();
  cv::VideoCapture video(path_);
  cv::Mat picture;
  ASSERT_TRUE(video.read(picture));
  ASSERT_TRUE(video.read(picture));
  ASSERT_EQ(picture.size(), cv::Size(160, 120));
  EXPECT_LT(cv::norm(picture.at<cv::Vec3b>(60, 20)), 30) << "bar left of the narrow frame";
  EXPECT_GT(cv::norm(picture.at<cv::Vec3b>(60, 80)), 60) << "the narrow frame itself";
  EXPECT_TRUE(video.read(picture));
}

TEST_F(OverlayVideoSink, NamesTheFolderThatDoesNotExist) {
  auto sink = sink_to(folder_ / "nowhere" / "overlay.mp4");
  EXPECT_THAT([&] { sink->open(info_); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("folder " + (folder_ / "nowhere").string() + " does not exist")));
}

TEST_F(OverlayVideoSink, ReportsAFileThatTurnsOutIncomplete) {
  auto sink = sink_to(path_);
  sink->open(info_);
  for (int i = 0; i < 3; ++i) write_frame(*sink, {160, 120});
  std::filesystem::remove(path_);  // what was written is gone, as on a full disk
  EXPECT_THAT([&] { sink->close(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is not complete")));
}

TEST_F(OverlayVideoSink, RefusesAPathWithoutExtension) {
  EXPECT_THROW(sink_to(folder_ / "overlay"), maggic::ConfigError);
}

TEST_F(OverlayVideoSink, EndsWithoutAFileWhenNoFrameCame) {
  auto sink = sink_to(path_);
  sink->open(info_);
  sink->close();
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
