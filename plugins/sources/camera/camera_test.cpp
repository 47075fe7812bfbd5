#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <opencv2/videoio.hpp>

#include "maggic/config_error.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace {

namespace fs = std::filesystem;
using maggic::Frame;
using maggic::ReadStatus;
using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::ThrowsMessage;

/// OpenCV takes a file for a camera too, which ends like one that is pulled out.
class CameraSource : public ::testing::Test {
 protected:
  CameraSource() {
    fs::create_directories(folder_);
    write_file(3);
  }
  ~CameraSource() override { fs::remove_all(folder_); }

  void write_file(int frames) const {
    cv::VideoWriter writer(file_, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
    const cv::Mat picture(48, 64, CV_8UC3, cv::Scalar::all(60));
    for (int i = 0; i < frames; ++i) writer.write(picture);
  }

  maggic::StagePtr<maggic::Source> camera(const std::string& yaml) {
    auto source = maggic::testing::registry().create<maggic::Source>("camera");
    maggic::configure_stage(*source, yaml, maggic::testing::standard_palette(), reporter_);
    return source;
  }

  std::string from_file(const std::string& more = "") const {
    return "{device: '" + file_ + "', backend: any" + more + "}";
  }

  static bool gives_a_frame(maggic::Source& source, Frame& frame) {
    const auto deadline = steady_clock::now() + std::chrono::seconds(5);
    while (steady_clock::now() < deadline) {
      if (source.read(frame) == ReadStatus::kFrame) return true;
    }
    return false;
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("camera_test_" + std::to_string(::getpid()));
  const std::string file_ = folder_ / "camera.avi";
  maggic::testing::RecordingReporter reporter_;
};

TEST_F(CameraSource, KeepsTheSourceContract) {
  write_file(2000);  // so that it is not lost meanwhile
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSource, "camera", from_file()),
              IsEmpty());
}

TEST_F(CameraSource, GivesFramesInUnixTimeAndIsLive) {
  auto source = camera(from_file());
  const maggic::SourceInfo info = source->open();
  EXPECT_TRUE(info.live);
  EXPECT_EQ(info.frame_count, std::nullopt);
  EXPECT_EQ(info.frames_per_second, 25.0);
  Frame frame;
  ASSERT_TRUE(gives_a_frame(*source, frame));
  EXPECT_EQ(frame.bgr.size(), cv::Size(64, 48));
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_LT(std::chrono::abs(now - frame.captured), std::chrono::seconds(5));
}

TEST_F(CameraSource, ComesBackAfterItWasLost) {
  auto source = camera(from_file());
  source->open();
  Frame frame;
  const auto says_back = [&] {
    const auto messages = reporter_.messages();
    return std::ranges::any_of(messages, [](const auto& m) { return m.find("is back") != m.npos; });
  };
  const auto deadline = steady_clock::now() + std::chrono::seconds(5);
  while (!says_back() && steady_clock::now() < deadline) source->read(frame);
  EXPECT_TRUE(says_back());
  EXPECT_TRUE(gives_a_frame(*source, frame));
}

TEST_F(CameraSource, ThatIsNotThereIsWaitedForWithoutBlocking) {
  auto source = camera("{device: " + (folder_ / "video9").string() + "}");
  EXPECT_TRUE(source->open().live);
  Frame frame;
  const auto begin = steady_clock::now();
  EXPECT_EQ(source->read(frame), ReadStatus::kRetry);
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(1));
  EXPECT_THAT(reporter_.messages(),
              ElementsAre(AllOf(HasSubstr("is not there"), HasSubstr("video9"),
                                HasSubstr("trying again"))));
}

TEST_F(CameraSource, MayBeRequiredAtTheStart) {
  auto source = camera("{device: 4321, required_at_start: true}");
  EXPECT_THAT([&] { source->open(); }, ThrowsMessage<std::runtime_error>(AllOf(
                                           HasSubstr("camera 4321"), HasSubstr("/dev/video4321"))));
}

TEST_F(CameraSource, NamesWhatTheDeviceDidNotTake) {
  auto source = camera(from_file(", width: 320, height: 240, gain: 7"));
  source->open();
  EXPECT_THAT(
      reporter_.messages(),
      IsSupersetOf({HasSubstr("asked for width 320, the device gives 64"),
                    HasSubstr("asked for height 240, the device gives 48"), HasSubstr("gain 7")}));
}

TEST_F(CameraSource, RefusesSettingsThatCannotBeMeant) {
  for (const char* yaml :
       {"{exposure: short}", "{white_balance: -5}", "{fourcc: MJPEG}", "{width: 640}",
        "{height: 480}", "{device: ''}", "{buffers: 0}", "{fps: 0}"}) {
    EXPECT_THROW(camera(yaml), maggic::ConfigError) << yaml;
  }
  EXPECT_NO_THROW(camera("{device: 0, exposure: auto, white_balance: 4500, fourcc: MJPG}"));
}

}  // namespace
