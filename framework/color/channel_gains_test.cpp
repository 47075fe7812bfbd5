#include "maggic/channel_gains.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

TEST(ChannelGains, LeaveEveryValueAtFactorOne) {
  for (int value = 0; value < 256; ++value) {
    EXPECT_EQ(ChannelGains()(1, static_cast<std::uint8_t>(value)), value);
  }
}

RC_GTEST_PROP(ChannelGains, MultiplyAndRound, ()) {
  // Factors that are whole steps of 1/4096, so that the formula holds to the last digit.
  const double factor = *rc::gen::inRange(0, 65536) / 4096.0;
  const auto value = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
  const double expected = std::min(255.0, std::floor(factor * value + 0.5));
  RC_ASSERT(double(ChannelGains({1.0, 1.0, factor})(2, value)) == expected);
}

TEST(ChannelGains, KeepFactorsInTheirRange) {
  EXPECT_EQ(ChannelGains({-1.0, 0.0, 1e9})(0, 200), 0);
  EXPECT_EQ(ChannelGains({-1.0, 0.0, 1e9})(2, 16), 255);
  EXPECT_EQ(ChannelGains({-1.0, 0.0, 1e9})(2, 1), 16);
}

TEST(ChannelGains, ChangeAPicturePixelByPixel) {
  const ChannelGains gains({0.5, 2.0, 1.0});
  cv::Mat picture(3, 5, CV_8UC3);
  cv::randu(picture, 0, 256);
  cv::Mat scaled;
  apply(gains, picture, scaled);
  ASSERT_EQ(scaled.size(), picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      EXPECT_EQ(scaled.at<cv::Vec3b>(y, x), gains(picture.at<cv::Vec3b>(y, x)));
    }
  }
}

}  // namespace
}  // namespace maggic
