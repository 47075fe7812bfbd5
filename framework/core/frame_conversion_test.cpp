#include "maggic/frame_conversion.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace maggic {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

template <class T>
cv::Vec3b converted_pixel(int type, const T& value) {
  cv::Mat picture(1, 1, type);
  picture.at<T>(0, 0) = value;
  EXPECT_EQ(convert_to_bgr8(picture), std::nullopt);
  EXPECT_EQ(picture.type(), CV_8UC3);
  return picture.at<cv::Vec3b>(0, 0);
}

TEST(FrameConversion, LeavesABgrPictureWhereItIs) {
  cv::Mat memory(5, 9, CV_8UC3, cv::Scalar(1, 2, 3));
  cv::Mat picture = memory(cv::Rect(1, 1, 7, 3));  // padded rows
  const cv::Mat before = picture;
  EXPECT_EQ(convert_to_bgr8(picture), std::nullopt);
  EXPECT_EQ(picture.data, before.data);
  EXPECT_EQ(picture.step, before.step);
}

TEST(FrameConversion, SpreadsGrayToThreeChannels) {
  EXPECT_EQ(converted_pixel<uchar>(CV_8UC1, 77), cv::Vec3b(77, 77, 77));
}

TEST(FrameConversion, DropsAlpha) {
  EXPECT_EQ(converted_pixel(CV_8UC4, cv::Vec4b(1, 2, 3, 0)), cv::Vec3b(1, 2, 3));
}

TEST(FrameConversion, RoundsEvery16BitValueToTheNearest) {
  cv::Mat picture;
  for (int half = 0; half < 2; ++half) {
    picture.create(1, 32768, CV_16UC1);
    for (int i = 0; i < 32768; ++i) {
      picture.at<ushort>(0, i) = static_cast<ushort>(half * 32768 + i);
    }
    ASSERT_EQ(convert_to_bgr8(picture), std::nullopt);
    for (int i = 0; i < 32768; ++i) {
      const int value = half * 32768 + i;
      ASSERT_EQ(picture.at<cv::Vec3b>(0, i)[1], std::lround(value / 257.0)) << value;
    }
  }
}

TEST(FrameConversion, Converts16BitWithAlphaInOneGo) {
  EXPECT_EQ(converted_pixel(CV_16UC4, cv::Vec4w(257, 514, 65535, 9)), cv::Vec3b(1, 2, 255));
}

TEST(FrameConversion, TakesFloatAsZeroToOneAndClampsTheRest) {
  EXPECT_EQ(converted_pixel(CV_32FC3, cv::Vec3f(0.0F, 0.5F, 1.0F)), cv::Vec3b(0, 128, 255));
  EXPECT_EQ(converted_pixel(CV_64FC3, cv::Vec3d(-1.0, 2.0, 0.2)), cv::Vec3b(0, 255, 51));
}

TEST(FrameConversion, SurvivesFloatsThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  converted_pixel(CV_32FC3, cv::Vec3f(nan, nan, nan));
}

TEST(FrameConversion, KeepsOddSizes) {
  cv::Mat picture(7, 13, CV_16UC1, cv::Scalar(65535));
  ASSERT_EQ(convert_to_bgr8(picture), std::nullopt);
  EXPECT_EQ(picture.size(), cv::Size(13, 7));
  EXPECT_EQ(picture.at<cv::Vec3b>(6, 12), cv::Vec3b(255, 255, 255));
}

TEST(FrameConversion, NeverWritesIntoTheMemoryItWasGiven) {
  std::vector<ushort> lent(4, 0xABCD);
  cv::Mat picture(2, 2, CV_16UC1, lent.data());
  ASSERT_EQ(convert_to_bgr8(picture), std::nullopt);
  EXPECT_THAT(lent, ::testing::Each(0xABCD));
}

TEST(FrameConversion, RefusesWhatIsNoPictureAndSaysWhy) {
  const auto refusal = [](cv::Mat picture) { return convert_to_bgr8(picture); };
  EXPECT_THAT(refusal(cv::Mat()), Optional(HasSubstr("empty")));
  EXPECT_THAT(refusal(cv::Mat(0, 5, CV_8UC3)), Optional(HasSubstr("empty")));
  EXPECT_THAT(refusal(cv::Mat(2, 2, CV_8UC2)), Optional(HasSubstr("2 channels")));
  EXPECT_THAT(refusal(cv::Mat(2, 2, CV_32SC1)), Optional(HasSubstr("CV_32S")));
  EXPECT_THAT(refusal(cv::Mat(1, 70000, CV_8UC3)),
              Optional(HasSubstr("70000 × 1 pixels, more than 65535 a side")));
  const int sizes[] = {2, 2, 2};
  EXPECT_THAT(refusal(cv::Mat(3, sizes, CV_8UC3)), Optional(HasSubstr("3 dimensions")));
}

}  // namespace
}  // namespace maggic
