#include "maggic/picture_row.hpp"

#include <vector>

#include <gmock/gmock.h>

namespace maggic {
namespace {

TEST(PictureRow, PutsPicturesNextToEachOtherUnderTheirTitles) {
  const std::vector<cv::Mat> pictures{cv::Mat(10, 20, CV_8UC3, cv::Scalar(1, 2, 3)),
                                      cv::Mat(30, 40, CV_8UC3, cv::Scalar(4, 5, 6))};
  const std::vector<std::string> titles{"A", "B"};
  const cv::Mat row = picture_row(pictures, titles);
  ASSERT_GE(row.cols, 60);
  ASSERT_GE(row.rows, 31);
  const int top = row.rows - 30;
  EXPECT_EQ(row.at<cv::Vec3b>(top, 0), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(row.at<cv::Vec3b>(top + 9, 19), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(row.at<cv::Vec3b>(top, row.cols - 40), cv::Vec3b(4, 5, 6));
  EXPECT_EQ(row.at<cv::Vec3b>(row.rows - 1, row.cols - 1), cv::Vec3b(4, 5, 6));
}

TEST(PictureRow, LeavesThePlaceOfAMissingPictureEmpty) {
  const std::vector<cv::Mat> pictures{cv::Mat(), cv::Mat(10, 50, CV_8UC3, cv::Scalar(1, 2, 3))};
  const std::vector<std::string> titles{"a title far too long to fit into fifty pixels", ""};
  const cv::Mat row = picture_row(pictures, titles);
  EXPECT_GE(row.cols, 100);
  EXPECT_EQ(row.at<cv::Vec3b>(row.rows - 1, row.cols - 1), cv::Vec3b(1, 2, 3));
}

TEST(PictureRow, NoPicturesGiveNoRow) {
  const std::vector<cv::Mat> pictures{cv::Mat()};
  const std::vector<std::string> titles{"A"};
  EXPECT_TRUE(picture_row(pictures, titles).empty());
}

}  // namespace
}  // namespace maggic
