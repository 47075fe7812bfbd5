#include "studio/session/jpeg.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace maggic::studio {
namespace {

TEST(Jpeg, ShowsThePictureOfAnySizeAlsoWhereItsRowsArePadded) {
  const cv::Mat large(40, 60, CV_8UC3, cv::Scalar(200, 100, 50));
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 5), cv::Size(33, 40)}) {
    const cv::Mat decoded = cv::imdecode(jpeg_of(large({{3, 0}, size})), cv::IMREAD_COLOR);
    ASSERT_EQ(decoded.size(), size);
    EXPECT_LE(cv::norm(decoded, cv::Mat(size, CV_8UC3, large.at<cv::Vec3b>(0, 0)), cv::NORM_INF),
              6);
  }
}

}  // namespace
}  // namespace maggic::studio
