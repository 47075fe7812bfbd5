#include "camera_settings.hpp"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace maggic::camera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// A device that takes what it knows, and remembers in which order.
class FakeCamera final : public cv::VideoCapture {
 public:
  bool set(int property, double value) override {
    asked_.push_back(property);
    if (!known_.contains(property)) return false;
    if (!stubborn_.contains(property)) known_[property] = value;
    return true;
  }
  double get(int property) const override {
    const auto found = known_.find(property);
    return found != known_.end() ? found->second : -1.0;
  }

  std::map<int, double> known_ = {{cv::CAP_PROP_FRAME_WIDTH, 640},
                                  {cv::CAP_PROP_FRAME_HEIGHT, 480},
                                  {cv::CAP_PROP_FPS, 30},
                                  {cv::CAP_PROP_FOURCC, 0x56595559},
                                  {cv::CAP_PROP_AUTO_EXPOSURE, 3},
                                  {cv::CAP_PROP_EXPOSURE, 156},
                                  {cv::CAP_PROP_GAIN, 0},
                                  {cv::CAP_PROP_AUTO_WB, 1},
                                  {cv::CAP_PROP_WB_TEMPERATURE, 4000},
                                  {cv::CAP_PROP_BUFFERSIZE, 4}};
  std::set<int> stubborn_;
  std::vector<int> asked_;
};

CameraSettings everything() {
  CameraSettings settings;
  settings.width_px = 1280;
  settings.height_px = 720;
  settings.fps = 60.0;
  settings.fourcc = "MJPG";
  settings.exposure = {Control::Mode::kValue, 80.0};
  settings.gain = 20.0;
  settings.white_balance = {Control::Mode::kValue, 4500.0};
  return settings;
}

TEST(CameraSettings, LeaveTheDeviceAsItIsUnlessAsked) {
  FakeCamera camera;
  EXPECT_THAT(apply({}, camera), IsEmpty());
  EXPECT_THAT(camera.asked_, ElementsAre(cv::CAP_PROP_BUFFERSIZE));
}

TEST(CameraSettings, AreAllSetWithTheFormatFirst) {
  FakeCamera camera;
  EXPECT_THAT(apply(everything(), camera), IsEmpty());
  EXPECT_EQ(camera.asked_.front(), cv::CAP_PROP_FOURCC);
  EXPECT_EQ(camera.get(cv::CAP_PROP_FOURCC), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
  EXPECT_EQ(camera.get(cv::CAP_PROP_FRAME_WIDTH), 1280);
  EXPECT_EQ(camera.get(cv::CAP_PROP_FRAME_HEIGHT), 720);
  EXPECT_EQ(camera.get(cv::CAP_PROP_FPS), 60);
  EXPECT_EQ(camera.get(cv::CAP_PROP_AUTO_EXPOSURE), 1);
  EXPECT_EQ(camera.get(cv::CAP_PROP_EXPOSURE), 80);
  EXPECT_EQ(camera.get(cv::CAP_PROP_GAIN), 20);
  EXPECT_EQ(camera.get(cv::CAP_PROP_AUTO_WB), 0);
  EXPECT_EQ(camera.get(cv::CAP_PROP_WB_TEMPERATURE), 4500);
}

TEST(CameraSettings, NameWhatTheDeviceGivesInstead) {
  FakeCamera camera;
  camera.stubborn_ = {cv::CAP_PROP_FRAME_WIDTH, cv::CAP_PROP_FPS, cv::CAP_PROP_FOURCC};
  EXPECT_THAT(apply(everything(), camera),
              UnorderedElementsAre("asked for fourcc MJPG, the device gives YUYV",
                                   "asked for width 1280, the device gives 640",
                                   "asked for fps 60, the device gives 30"));
}

TEST(CameraSettings, NameWhatTheDeviceDoesNotHave) {
  FakeCamera camera;
  for (const int property : {cv::CAP_PROP_GAIN, cv::CAP_PROP_AUTO_EXPOSURE, cv::CAP_PROP_BUFFERSIZE,
                             cv::CAP_PROP_WB_TEMPERATURE}) {
    camera.known_.erase(property);
  }
  EXPECT_THAT(apply(everything(), camera),
              UnorderedElementsAre("the device does not take gain 20",
                                   "the device does not take exposure by hand",
                                   "the device does not take white_balance 4500"));
}

TEST(CameraSettings, AutomaticExposureIsWhicheverTheCameraKnows) {
  CameraSettings settings;
  settings.exposure.mode = Control::Mode::kAuto;
  settings.white_balance.mode = Control::Mode::kAuto;
  FakeCamera camera;
  camera.known_[cv::CAP_PROP_AUTO_EXPOSURE] = 1;
  camera.known_[cv::CAP_PROP_AUTO_WB] = 0;
  EXPECT_THAT(apply(settings, camera), IsEmpty());
  EXPECT_EQ(camera.get(cv::CAP_PROP_AUTO_EXPOSURE), 3);
  EXPECT_EQ(camera.get(cv::CAP_PROP_AUTO_WB), 1);

  camera.stubborn_ = {cv::CAP_PROP_AUTO_EXPOSURE};
  camera.known_[cv::CAP_PROP_AUTO_EXPOSURE] = 1;
  EXPECT_THAT(apply(settings, camera), ElementsAre(HasSubstr("exposure auto")));
}

TEST(CameraControl, IsKeepAutoOrANumber) {
  EXPECT_EQ(control_from("keep")->mode, Control::Mode::kKeep);
  EXPECT_EQ(control_from("auto")->mode, Control::Mode::kAuto);
  EXPECT_EQ(control_from("156")->mode, Control::Mode::kValue);
  EXPECT_EQ(control_from("0.5")->value, 0.5);
  for (const char* text : {"", "Auto", "-1", "1 ", "inf", "nan", "12ms", "1e999"}) {
    EXPECT_EQ(control_from(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace maggic::camera
