#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <opencv2/videoio.hpp>

#include "file_server_for_tests.hpp"
#include "maggic/config_error.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class VideoSource : public ::testing::Test {
 protected:
  VideoSource() { fs::create_directories(folder_); }
  ~VideoSource() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }

  /// Frame i is gray, of brightness 10·i.
  static cv::Mat picture(int i) { return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(10 * i)); }

  std::string write_video(const std::string& name, int frames, const char* fourcc = "MJPG",
                          double fps = 25) {
    cv::VideoWriter writer(path(name),
                           cv::VideoWriter::fourcc(fourcc[0], fourcc[1], fourcc[2], fourcc[3]), fps,
                           {64, 48});
    EXPECT_TRUE(writer.isOpened());
    for (int i = 0; i < frames; ++i) writer.write(picture(i));
    return path(name);
  }

  std::string write_text(const std::string& name, const std::string& content) {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  static std::string content_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  StagePtr<Source> source_of(const std::string& file, const std::string& more = "") {
    auto source = testing::registry().create<Source>("video");
    configure_stage(*source, "{path: '" + file + "'" + more + "}", testing::standard_palette(),
                    reporter_);
    return source;
  }

  std::string error_of(const std::string& file) {
    try {
      source_of(file)->open();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "no error";
  }

  struct Seen {
    std::vector<int> pictures;  ///< Numbers of the frames, by their brightness.
    std::vector<int> times_ms;
  };

  static Seen frames_of(Source& source, std::size_t most = 1000) {
    Seen seen;
    Frame frame;
    while (seen.pictures.size() < most && source.read(frame) == ReadStatus::kFrame) {
      seen.pictures.push_back((frame.bgr.at<cv::Vec3b>(24, 32)[1] + 5) / 10);
      seen.times_ms.push_back(static_cast<int>(frame.captured / milliseconds(1)));
    }
    return seen;
  }

  static bool gives_a_frame(Source& source, Frame& frame) {
    const auto deadline = steady_clock::now() + std::chrono::seconds(5);
    while (steady_clock::now() < deadline) {
      if (source.read(frame) == ReadStatus::kFrame) return true;
    }
    return false;
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("video_test_" + std::to_string(::getpid()));
  testing::RecordingReporter reporter_;
};

TEST_F(VideoSource, KeepsTheSourceContract) {
  const std::string file = write_video("a.avi", 5);
  EXPECT_THAT(testing::check_conformance(StageKind::kSource, "video", "{path: '" + file + "'}"),
              IsEmpty());
  EXPECT_THAT(
      testing::check_conformance(StageKind::kSource, "video", "{path: '" + file + "', loop: true}"),
      IsEmpty());
}

TEST_F(VideoSource, GivesEveryFrameInOrderWithItsTime) {
  for (const auto& [name, fourcc] : {std::pair("a.avi", "MJPG"), std::pair("a.mp4", "mp4v")}) {
    auto source = source_of(write_video(name, 6, fourcc));
    const SourceInfo info = source->open();
    EXPECT_FALSE(info.live);
    EXPECT_EQ(info.frame_count, 6u);
    EXPECT_EQ(info.frames_per_second, 25.0);
    const Seen seen = frames_of(*source);
    EXPECT_THAT(seen.pictures, ElementsAre(0, 1, 2, 3, 4, 5)) << name;
    EXPECT_THAT(seen.times_ms, ElementsAre(0, 40, 80, 120, 160, 200)) << name;
    Frame frame;
    EXPECT_EQ(source->read(frame), ReadStatus::kEnd);
  }
  EXPECT_THAT(reporter_.messages(), IsEmpty());
}

TEST_F(VideoSource, LoopsForEverWhileTimeRunsOn) {
  auto source = source_of(write_video("a.avi", 3), ", loop: true");
  EXPECT_EQ(source->open().frame_count, std::nullopt);
  const Seen seen = frames_of(*source, 7);
  EXPECT_THAT(seen.pictures, ElementsAre(0, 1, 2, 0, 1, 2, 0));
  EXPECT_THAT(seen.times_ms, ElementsAre(0, 40, 80, 120, 160, 200, 240));
  EXPECT_THAT(reporter_.messages(), IsEmpty());
}

TEST_F(VideoSource, RepairsTheTimesOfAFileWithoutAContainerAndSaysSoOnce) {
  // OpenCV gives such positions as −7.7·10¹⁵, standing still at first and 0 at last.
  auto source = source_of(write_video("raw.m1v", 20, "mpg1"));
  source->open();
  const Seen seen = frames_of(*source);
  ASSERT_THAT(seen.times_ms, SizeIs(20));
  EXPECT_EQ(seen.times_ms[0], 0);
  for (std::size_t i = 1; i < 20; ++i) {
    const int step_ms = seen.times_ms[i] - seen.times_ms[i - 1];
    EXPECT_GE(step_ms, 38);
    EXPECT_LE(step_ms, 82);
  }
  EXPECT_THAT(reporter_.messages(), ElementsAre(HasSubstr("no usable time for frame")));
}

TEST_F(VideoSource, DecodesIntoTheHostsMemory) {
  auto source = source_of(write_video("a.avi", 4));
  source->open();
  Frame frame;
  ASSERT_EQ(source->read(frame), ReadStatus::kFrame);
  const uchar* const memory = frame.bgr.data;
  for (int i = 1; i < 4; ++i) {
    ASSERT_EQ(source->read(frame), ReadStatus::kFrame);
    EXPECT_EQ(frame.bgr.data, memory);
  }
}

TEST_F(VideoSource, TakesPathsThatLookLikeSomethingElse) {
  const std::string file = write_video("a.avi", 2);
  for (const char* name : {"tcp:100%d.avi", "no extension", "[1] a*.avi"}) {
    fs::copy_file(file, path(name));
    auto source = source_of(path(name));
    source->open();
    EXPECT_THAT(frames_of(*source).pictures, SizeIs(2)) << name;
  }
  auto source = source_of("file://" + file);
  EXPECT_FALSE(source->open().live);
}

TEST_F(VideoSource, RefusesWhatIsNoVideoAndSaysWhy) {
  EXPECT_THAT(error_of(path("nowhere.mp4")), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of(folder_), AllOf(HasSubstr("it is a folder"), HasSubstr("images")));
  EXPECT_THAT(error_of(write_text("empty.mp4", "")), HasSubstr("it is empty"));
  EXPECT_THAT(error_of(write_text("text.mp4", "dear diary\n")),
              HasSubstr("no frame could be read"));
  EXPECT_THAT(error_of(write_text("binary.avi", std::string(5000, '\x9c'))),
              HasSubstr("no frame could be read"));
  EXPECT_THAT(error_of("/dev/null"), HasSubstr("no frame could be read"));
  EXPECT_THAT(error_of(write_video("none.avi", 0)), HasSubstr("no frame could be read"));
}

TEST_F(VideoSource, RefusesAVideoCutOffBeforeItsFirstFrame) {
  const std::string mp4 = write_video("cut.mp4", 20, "mp4v");
  fs::resize_file(mp4, fs::file_size(mp4) / 2);  // its index stands at the end
  EXPECT_THAT(error_of(mp4), HasSubstr("no frame could be read"));
  const std::string avi = write_video("cut.avi", 20);
  fs::resize_file(avi, 200);
  EXPECT_THAT(error_of(avi), HasSubstr("no frame could be read"));
}

TEST_F(VideoSource, GivesWhatIsLeftOfAVideoCutOffLaterAndSaysSo) {
  const std::string avi = write_video("cut.avi", 20);
  fs::resize_file(avi, fs::file_size(avi) * 3 / 4);
  auto source = source_of(avi);
  source->open();
  const Seen seen = frames_of(*source);
  EXPECT_GE(seen.pictures.size(), 3u);
  EXPECT_LT(seen.pictures.size(), 18u);
  EXPECT_THAT(reporter_.messages(), ElementsAre(HasSubstr("of 20 frames")));
}

TEST_F(VideoSource, EndsWithAnErrorWhenTheFileVanishesWhileLooping) {
  const std::string file = write_video("a.avi", 2);
  auto source = source_of(file, ", loop: true");
  source->open();
  frames_of(*source, 2);
  fs::remove(file);
  EXPECT_THROW(frames_of(*source, 1), std::runtime_error);
}

TEST_F(VideoSource, TakesAStreamAsLiveAndOpensItAgainWhenItEnds) {
  video::FileServer server(content_of(write_video("raw.mjpeg", 20)));
  server.begin();
  auto source = source_of(server.url());
  const SourceInfo info = source->open();
  EXPECT_TRUE(info.live);
  EXPECT_EQ(info.frame_count, std::nullopt);
  Frame frame;
  ASSERT_TRUE(gives_a_frame(*source, frame));
  EXPECT_EQ(frame.bgr.size(), cv::Size(64, 48));
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_LT(std::chrono::abs(now - frame.captured), std::chrono::seconds(5));

  const auto deadline = steady_clock::now() + std::chrono::seconds(5);
  while (server.served() < 2 && steady_clock::now() < deadline) source->read(frame);
  EXPECT_TRUE(gives_a_frame(*source, frame));
  EXPECT_THAT(reporter_.messages(),
              Contains(AllOf(HasSubstr("stream tcp://127.0.0.1"), HasSubstr("gives no picture"))));
}

TEST_F(VideoSource, WaitsForAStreamThatIsNotThereYet) {
  video::FileServer server(content_of(write_video("raw.mjpeg", 20)));
  auto source = source_of(server.url());
  EXPECT_TRUE(source->open().live);
  Frame frame;
  EXPECT_EQ(source->read(frame), ReadStatus::kRetry);
  server.begin();
  EXPECT_TRUE(gives_a_frame(*source, frame));
}

TEST_F(VideoSource, RefusesToLoopAStream) {
  EXPECT_THROW(source_of("rtsp://camera/live", ", loop: true"), ConfigError);
}

}  // namespace
}  // namespace maggic
