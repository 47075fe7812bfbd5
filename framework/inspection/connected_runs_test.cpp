#include "inspection/connected_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <opencv2/imgproc.hpp>

#include "maggic/run_scanner.hpp"

namespace maggic {
namespace {

using ::testing::IsEmpty;

std::vector<Run> runs_of(const cv::Mat1b& labels) {
  std::vector<Run> runs;
  RunScanner().scan_labels(labels, whole_picture(labels.size()), runs);
  return runs;
}

TEST(ConnectedRuns, FollowsCornersAndStaysWithOneLabel) {
  const cv::Mat1b labels = (cv::Mat1b(3, 4) << 1, 0, 0, 0,  //
                            0, 1, 2, 0,                     //
                            0, 0, 0, 2);
  const auto runs = runs_of(labels);
  EXPECT_EQ(connected_runs(runs, {0, 0}).size(), 2U);
  EXPECT_EQ(connected_runs(runs, {3, 2}).size(), 2U);
  EXPECT_EQ(connected_runs(runs, {3, 2}).front().label, 2);
  EXPECT_THAT(connected_runs(runs, {3, 0}), IsEmpty());
  EXPECT_EQ(run_at(runs, {0, 1}), nullptr);
  EXPECT_EQ(run_at(runs, {2, 1})->label, 2);
}

RC_GTEST_PROP(ConnectedRunsProperty, IsTheRegionOpenCvFinds, ()) {
  const cv::Size size(*rc::gen::inRange(1, 14), *rc::gen::inRange(1, 14));
  cv::Mat1b labels(size);
  for (std::uint8_t& label : labels) label = *rc::gen::inRange<std::uint8_t>(0, 3);
  const cv::Point at(*rc::gen::inRange(0, size.width), *rc::gen::inRange(0, size.height));

  cv::Mat expected = cv::Mat::zeros(size, CV_8UC1);
  if (labels(at) != kBackground) {
    cv::Mat regions;
    cv::connectedComponents(labels == labels(at), regions, 8);
    expected = regions == regions.at<int>(at);
  }
  cv::Mat found;
  draw_runs(connected_runs(runs_of(labels), at), size, found);
  RC_ASSERT(cv::countNonZero((found != 0) != (expected != 0)) == 0);
}

}  // namespace
}  // namespace maggic
