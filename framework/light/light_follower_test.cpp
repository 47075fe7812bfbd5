#include "maggic/light_follower.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <opencv2/core.hpp>

namespace maggic {
namespace {

using std::chrono::milliseconds;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::IsNull;
using ::testing::NotNull;

const cv::Size kSize(320, 240);
const cv::Vec3b kFloor(40, 50, 60);  // blue, green, red

Field field_for(cv::Size size) { return Field(FieldParameters{}, size); }

LightParameters following() {
  LightParameters parameters;
  parameters.follow = true;
  parameters.reference_rgb = {60.0, 50.0, 40.0};
  return parameters;
}

cv::Mat floor_in_light(double red, double green, double blue) {
  return cv::Mat(kSize, CV_8UC3, cv::Scalar(kFloor[0] * blue, kFloor[1] * green, kFloor[2] * red));
}

TEST(SceneColor, IsTheFloorWhateverStandsOnIt) {
  cv::Mat picture = floor_in_light(1.0, 1.0, 1.0);
  picture(cv::Rect(100, 60, 60, 60)).setTo(cv::Scalar(255, 0, 255));
  picture(cv::Rect(180, 60, 60, 60)).setTo(cv::Scalar(255, 255, 255));
  const std::array<double, 3> color = scene_color(picture, field_for(kSize));
  EXPECT_DOUBLE_EQ(color[0], 60.0);
  EXPECT_DOUBLE_EQ(color[1], 50.0);
  EXPECT_DOUBLE_EQ(color[2], 40.0);
}

TEST(SceneColor, LooksInsideTheFieldOnly) {
  FieldParameters parameters;
  parameters.corners_px = {{160, 10}, {300, 10}, {300, 230}, {160, 230}};
  cv::Mat picture = floor_in_light(1.0, 1.0, 1.0);
  picture(cv::Rect(0, 0, 150, 240)).setTo(cv::Scalar(200, 200, 200));
  EXPECT_DOUBLE_EQ(scene_color(picture, Field(parameters, kSize))[0], 60.0);
}

TEST(LightFollower, LeavesColoursAloneInTheLightOfTheCalibration) {
  LightFollower follower(following());
  EXPECT_THAT(follower.look(floor_in_light(1.0, 1.0, 1.0), field_for(kSize), milliseconds(0)),
              IsNull());
  EXPECT_THAT(follower.look(floor_in_light(1.02, 1.0, 0.99), field_for(kSize), milliseconds(16)),
              IsNull());
}

TEST(LightFollower, DoesNothingUnlessAsked) {
  LightFollower follower({});
  EXPECT_THAT(follower.look(floor_in_light(0.4, 0.3, 0.2), field_for(kSize), milliseconds(0)),
              IsNull());
}

TEST(LightFollower, TakesDimWarmLightBackToTheCalibration) {
  LightFollower follower(following());
  const ChannelGains* gains =
      follower.look(floor_in_light(0.5, 0.4, 0.25), field_for(kSize), milliseconds(0));
  ASSERT_THAT(gains, NotNull());
  EXPECT_EQ((*gains)(2, 30), 60);
  EXPECT_EQ((*gains)(1, 20), 50);
  EXPECT_EQ((*gains)(0, 10), 40);
  EXPECT_EQ((*gains)(0, 0), 0);
  EXPECT_EQ((*gains)(0, 200), 255);  // brighter than the sensor can tell
}

TEST(LightFollower, SettlesOverHalfASecondOfCaptureTime) {
  LightFollower follower(following());
  const Field field = field_for(kSize);
  follower.look(floor_in_light(1.0, 1.0, 1.0), field, milliseconds(0));
  const cv::Mat dim = floor_in_light(0.5, 0.5, 0.5);
  for (int ms = 10; ms <= 500; ms += 10) follower.look(dim, field, milliseconds(ms));
  EXPECT_THAT(follower.gains(), Each(DoubleNear(1.0 + (1.0 - std::exp(-1.0)), 0.02)));
  for (int ms = 510; ms <= 5000; ms += 10) follower.look(dim, field, milliseconds(ms));
  EXPECT_THAT(follower.gains(), Each(DoubleNear(2.0, 0.01)));
}

TEST(LightFollower, BelievesTheLightAtOnceAfterAJumpInTime) {
  LightFollower follower(following());
  const Field field = field_for(kSize);
  follower.look(floor_in_light(1.0, 1.0, 1.0), field, milliseconds(10'000));
  follower.look(floor_in_light(0.5, 0.5, 0.5), field, milliseconds(0));
  EXPECT_THAT(follower.gains(), Each(DoubleNear(2.0, 0.01)));
}

TEST(LightFollower, LearnsNothingFromABlackPicture) {
  LightFollower follower(following());
  EXPECT_THAT(follower.look(floor_in_light(0.0, 0.0, 0.0), field_for(kSize), milliseconds(0)),
              IsNull());
  EXPECT_THAT(follower.gains(), Each(1.0));
}

RC_GTEST_PROP(LightFollower, TakesAnyLightBackToWithinAStep, ()) {
  const double red = *rc::gen::inRange(25, 300) / 100.0;
  const double green = *rc::gen::inRange(25, 300) / 100.0;
  const double blue = *rc::gen::inRange(25, 300) / 100.0;
  LightFollower follower(following());
  const cv::Mat picture = floor_in_light(red, green, blue);
  const ChannelGains* gains = follower.look(picture, field_for(kSize), milliseconds(0));
  cv::Mat scaled = picture.clone();
  if (gains != nullptr) apply(*gains, picture, scaled);
  const cv::Vec3b floor = scaled.at<cv::Vec3b>(120, 160);
  for (int channel = 0; channel < 3; ++channel) {
    RC_ASSERT(std::abs(floor[channel] - kFloor[channel]) <= 2);
  }
}

}  // namespace
}  // namespace maggic
