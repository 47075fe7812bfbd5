#include "calibration/chroma_frame.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "calibration/tags_for_tests.hpp"
#include "maggic/picture_colors.hpp"

namespace maggic::calibration {
namespace {

TEST(ChromaFrame, HoldsSpreadAndHueOfEveryPixel) {
  const ChromaFrame frame = tags::look_at(cv::Mat(5, 7, CV_8UC3, cv::Scalar(30, 200, 10)));
  EXPECT_EQ(frame.spread.size(), cv::Size(7, 5));
  EXPECT_EQ(frame.spread.at<std::uint8_t>(2, 3), 190);
  EXPECT_EQ(frame.hue.at<std::uint8_t>(2, 3), hue_of({30, 200, 10}));
}

TEST(ChromaFrame, ALonePixelOfNoiseIsGone) {
  cv::Mat picture(9, 9, CV_8UC3, cv::Scalar(60, 60, 60));
  picture.at<cv::Vec3b>(4, 4) = {0, 0, 255};
  EXPECT_EQ(cv::countNonZero(tags::look_at(picture).spread), 0);
}

TEST(Hue, OfThePrimariesIsAThirdOfTheCircleApart) {
  EXPECT_EQ(hue_of({0, 0, 255}), 0);
  EXPECT_EQ(hue_of({0, 255, 0}), 85);
  EXPECT_EQ(hue_of({255, 0, 0}), 171);
}

TEST(HueDifference, GoesTheShortWayRound) {
  EXPECT_EQ(hue_difference(2.0, 254.0), 4.0);
  EXPECT_EQ(hue_difference(254.0, 2.0), -4.0);
  EXPECT_EQ(hue_difference(128.0, 0.0), -128.0);
}

RC_GTEST_PROP(HueDifferenceProperty, LeadsFromOneHueToTheOther, ()) {
  const double from = *rc::gen::inRange(0, 256);
  const double to = *rc::gen::inRange(0, 256);
  const double way = hue_difference(to, from);
  RC_ASSERT(way >= -128.0);
  RC_ASSERT(way < 128.0);
  RC_ASSERT(std::fmod(from + way + 256.0, 256.0) == to);
}

}  // namespace
}  // namespace maggic::calibration
