#include "live/reconnecting_device.hpp"

#include <atomic>
#include <functional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "maggic/testing.hpp"

namespace maggic::live {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

using Answer = std::optional<std::string>;

constexpr milliseconds kLong{2000};  // only waited for in full when a test fails
constexpr int kAll = 1 << 30;

/// What the test wants the device to do, and what was done to it. Outlives the device.
struct Script {
  std::function<Answer(int attempt)> open = [](int) { return Answer(); };
  std::function<Answer(int picture, Timestamp& captured)> read = [](int, Timestamp&) {
    std::this_thread::sleep_for(milliseconds(1));
    return Answer();
  };
  std::atomic<int> pictures_allowed{kAll};  ///< `read` waits before it goes beyond.
  std::atomic<int> opened{0};
  std::atomic<int> closed{0};
  std::atomic<int> pictures{0};
  std::vector<steady_clock::time_point> attempts;  // of the device's thread; read after its end
};

class ScriptedDevice final : public FrameDevice {
 public:
  explicit ScriptedDevice(Script& script) : script_(script) {}

  Answer open() override {
    script_.attempts.push_back(steady_clock::now());
    return script_.open(script_.opened++);
  }
  Answer read(cv::Mat& picture, Timestamp& captured) override {
    const int number = script_.pictures++;
    while (number >= script_.pictures_allowed) std::this_thread::sleep_for(milliseconds(1));
    captured = milliseconds(number);
    if (Answer failure = script_.read(number, captured)) return failure;
    picture.create(2, 3, CV_8UC3);
    picture.setTo(cv::Scalar::all(number % 256));
    return std::nullopt;
  }
  void close() override { ++script_.closed; }

 private:
  Script& script_;
};

class AReconnectingDevice : public ::testing::Test {
 protected:
  ~AReconnectingDevice() override { script_.pictures_allowed = kAll; }

  ReconnectingDevice& start(bool required = false,
                            RetryPauses pauses = {milliseconds(1), milliseconds(4)}) {
    device_.emplace(std::make_unique<ScriptedDevice>(script_), "camera 7", reporter_, pauses);
    device_->start(required);
    return *device_;
  }

  Script script_;
  testing::RecordingReporter reporter_;
  Frame frame_;
  std::optional<ReconnectingDevice> device_;  // ends before what it refers to
};

TEST_F(AReconnectingDevice, GivesPicturesWithTheirTimes) {
  ReconnectingDevice& device = start();
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
    EXPECT_EQ(frame_.bgr.at<cv::Vec3b>(1, 2)[0], frame_.captured / milliseconds(1) % 256);
  }
  EXPECT_THAT(reporter_.messages(), IsEmpty());
}

TEST_F(AReconnectingDevice, GivesTheNewestPictureAndNoneTwice) {
  script_.pictures_allowed = 5;
  ReconnectingDevice& device = start();
  while (script_.pictures < 6) std::this_thread::yield();
  ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
  EXPECT_EQ(frame_.captured, milliseconds(4));
  EXPECT_EQ(device.read(frame_, milliseconds(5)), ReadStatus::kRetry);
}

TEST_F(AReconnectingDevice, ReadReturnsInTimeWhileTheDeviceBlocks) {
  script_.pictures_allowed = 0;
  ReconnectingDevice& device = start();
  EXPECT_EQ(device.read(frame_, milliseconds(10)), ReadStatus::kRetry);
  script_.pictures_allowed = kAll;
  EXPECT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
}

TEST_F(AReconnectingDevice, ThatIsNotThereAtFirstIsTriedUntilItIs) {
  script_.open = [](int attempt) { return attempt < 4 ? Answer("unplugged") : Answer(); };
  EXPECT_EQ(start().read(frame_, kLong), ReadStatus::kFrame);
  EXPECT_EQ(script_.opened, 5);
  EXPECT_THAT(reporter_.messages(),
              ElementsAre(AllOf(HasSubstr("camera 7 is not there: unplugged"), HasSubstr("again")),
                          HasSubstr("camera 7 is back after")));
}

TEST_F(AReconnectingDevice, ThatIsRequiredAndNotThereIsAnError) {
  script_.open = [](int) { return Answer("unplugged"); };
  EXPECT_THAT([&] { start(true); },
              ThrowsMessage<std::runtime_error>(HasSubstr("camera 7: unplugged")));
  EXPECT_EQ(script_.opened, 1);
}

TEST_F(AReconnectingDevice, ThatIsLostIsClosedAndOpenedAgain) {
  script_.read = [](int number, Timestamp&) {
    std::this_thread::sleep_for(milliseconds(1));
    return number == 3 ? Answer("gone") : Answer();
  };
  ReconnectingDevice& device = start();
  while (frame_.captured < milliseconds(6)) {
    ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
  }
  EXPECT_EQ(script_.opened, 2);
  EXPECT_EQ(script_.closed, 1);
  EXPECT_THAT(reporter_.messages(), ElementsAre(HasSubstr("camera 7 gives no picture: gone"),
                                                HasSubstr("camera 7 is back")));
}

TEST_F(AReconnectingDevice, SaysWhenTheReasonChanges) {
  script_.open = [](int attempt) {
    if (attempt < 3) return Answer("no device");
    return attempt < 6 ? Answer("no permission") : Answer();
  };
  start().read(frame_, kLong);
  EXPECT_THAT(reporter_.messages(), ElementsAre(HasSubstr("no device"), HasSubstr("no permission"),
                                                HasSubstr("is back")));
}

TEST_F(AReconnectingDevice, TakesExceptionsForFailures) {
  script_.open = [](int attempt) -> Answer {
    if (attempt == 0) throw std::runtime_error("driver fell over");
    return std::nullopt;
  };
  script_.read = [](int number, Timestamp&) -> Answer {
    if (number == 0) throw std::runtime_error("bad cable");
    std::this_thread::sleep_for(milliseconds(1));
    return std::nullopt;
  };
  EXPECT_EQ(start().read(frame_, kLong), ReadStatus::kFrame);
  EXPECT_THAT(reporter_.messages(), ElementsAre(HasSubstr("driver fell over"),
                                                HasSubstr("bad cable"), HasSubstr("is back")));
}

TEST_F(AReconnectingDevice, PausesLongerAndLongerUpToALimit) {
  // Opening works and reading does not: that must not start the pauses anew.
  script_.read = [](int, Timestamp&) { return Answer("nothing comes"); };
  start(false, {milliseconds(4), milliseconds(16)});
  while (script_.opened < 7) std::this_thread::sleep_for(milliseconds(1));
  device_.reset();
  const auto pause = [&](std::size_t i) { return script_.attempts[i + 1] - script_.attempts[i]; };
  EXPECT_GE(pause(0), milliseconds(4));
  EXPECT_GE(pause(1), milliseconds(8));
  EXPECT_GE(pause(2), milliseconds(16));
  EXPECT_GE(pause(5), milliseconds(16));
  EXPECT_LT(pause(5), milliseconds(400)) << "32, 64 … would mean that there is no limit";
}

TEST_F(AReconnectingDevice, EndsPromptlyDuringALongPause) {
  script_.open = [](int) { return Answer("unplugged"); };
  start(false, {std::chrono::hours(1), std::chrono::hours(1)});
  const auto begin = steady_clock::now();
  device_.reset();
  EXPECT_LT(steady_clock::now() - begin, kLong);
}

TEST_F(AReconnectingDevice, NeverLetsTimeRunBackwards) {
  script_.read = [](int number, Timestamp& captured) {
    std::this_thread::sleep_for(milliseconds(1));
    captured = milliseconds(number % 2 == 0 ? 1000 : 10);
    return Answer();
  };
  ReconnectingDevice& device = start();
  Timestamp last{0};
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
    EXPECT_GE(frame_.captured, last);
    last = frame_.captured;
  }
}

TEST_F(AReconnectingDevice, ExchangesBuffersButLeavesLentAndSharedOnesAlone) {
  ReconnectingDevice& device = start();
  std::vector<uchar> lent(18, 0);
  frame_.bgr = cv::Mat(2, 3, CV_8UC3, lent.data());
  ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
  EXPECT_EQ(frame_.bgr.data, lent.data()) << "written into";

  frame_.bgr = cv::Mat();
  ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
  const cv::Mat kept = frame_.bgr;
  const cv::Mat before = kept.clone();
  frame_.bgr = cv::Mat();
  for (int i = 0; i < 5; ++i) ASSERT_EQ(device.read(frame_, kLong), ReadStatus::kFrame);
  EXPECT_EQ(cv::norm(kept, before), 0.0);
}

}  // namespace
}  // namespace maggic::live
