#include "measurement/yardsticks.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

/// A part of a larger picture, so that its rows are padded.
cv::Mat padded_noise(int width, int height) {
  cv::Mat whole(height + 2, width + 5, CV_8UC3);
  cv::RNG(3).fill(whole, cv::RNG::UNIFORM, 0, 256);
  return whole(cv::Rect(2, 1, width, height));
}

void expect_ors(const cv::Mat& bgr, const cv::Mat& ors) {
  ASSERT_EQ(ors.size(), bgr.size());
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const auto pixel = bgr.at<cv::Vec3b>(y, x);
      ASSERT_EQ(ors.at<std::uint8_t>(y, x), pixel[0] | pixel[1] | pixel[2]) << x << ',' << y;
    }
  }
}

TEST(Yardsticks, JoinEveryPixelsChannelsAtAnyWidth) {
  for (const int width : {1, 15, 16, 63, 64, 65, 200, 333}) {
    for (const bool padded : {true, false}) {
      const cv::Mat bgr = padded ? padded_noise(width, 3) : padded_noise(width, 3).clone();
      cv::Mat ors;
      join_channels(bgr, ors);
      expect_ors(bgr, ors);
    }
  }
}

TEST(Yardsticks, JoinChannelsIntoRowsThatArePadded) {
  const cv::Mat bgr = padded_noise(64, 3).clone();
  cv::Mat whole(3, 80, CV_8UC1, cv::Scalar(7));
  cv::Mat ors = whole(cv::Rect(0, 0, 64, 3));
  join_channels(bgr, ors);
  expect_ors(bgr, ors);
  EXPECT_EQ(cv::countNonZero(whole(cv::Rect(64, 0, 16, 3)) != 7), 0);
}

TEST(Yardsticks, LookUpWhatTheTableSays) {
  const ColorTable table =
      ColorTable::compile(fakes::SameNormalizer(), fakes::RedSegmenter(), 2, 1);
  const std::vector<Label> flat = flat_labels(table);
  const cv::Mat bgr = padded_noise(77, 5);
  cv::Mat labels;
  look_up_each_pixel(bgr, flat, labels);
  ASSERT_EQ(labels.size(), bgr.size());
  int colored = 0;
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const auto pixel = bgr.at<cv::Vec3b>(y, x);
      ASSERT_EQ(labels.at<Label>(y, x), table(pixel[0], pixel[1], pixel[2])) << x << ',' << y;
      colored += labels.at<Label>(y, x);
    }
  }
  EXPECT_GT(colored, 0);
  EXPECT_LT(colored, 77 * 5);
}

}  // namespace
}  // namespace maggic
