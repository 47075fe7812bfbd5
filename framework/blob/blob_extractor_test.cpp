#include "maggic/blob_extractor.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <opencv2/core.hpp>

#include "maggic/run_scanner.hpp"

namespace maggic {
namespace {

std::vector<Run> runs_of(const cv::Mat& labels) {
  std::vector<maggic::Run> runs;
  RunScanner().scan_labels(labels, whole_picture(labels.size()), runs);
  return runs;
}

std::vector<Blob> blobs_of(const cv::Mat& labels, const BlobExtractor::Limits& limits = {}) {
  BlobExtractor extractor;
  std::vector<Blob> blobs;
  extractor.extract(runs_of(labels), limits, blobs);
  return blobs;
}

/// A label image from rows of digits.
cv::Mat picture(const std::vector<std::string>& rows) {
  cv::Mat labels(static_cast<int>(rows.size()), static_cast<int>(rows.front().size()), CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels.at<Label>(y, x) = static_cast<Label>(rows[y][x] - '0');
    }
  }
  return labels;
}

/// The blobs by flood fill, pixel by pixel, in the order of their first pixels.
std::vector<Blob> flood_fill_blobs(const cv::Mat& labels) {
  std::vector<Blob> blobs;
  cv::Mat1b seen(labels.size(), 0);
  for (int y0 = 0; y0 < labels.rows; ++y0) {
    for (int x0 = 0; x0 < labels.cols; ++x0) {
      const Label label = labels.at<Label>(y0, x0);
      if (label == kBackground || seen(y0, x0) != 0) continue;
      std::vector<cv::Point> pixels{{x0, y0}};
      seen(y0, x0) = 1;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const cv::Point next = pixels[i] + cv::Point(dx, dy);
            if (!cv::Rect({}, labels.size()).contains(next) || seen(next) != 0) continue;
            if (labels.at<Label>(next) != label) continue;
            seen(next) = 1;
            pixels.push_back(next);
          }
        }
      }
      Blob blob;
      blob.label = label;
      blob.area_px = static_cast<int>(pixels.size());
      const auto n = static_cast<double>(pixels.size());
      int right = x0;
      int bottom = y0;
      int left = x0;
      for (const cv::Point& p : pixels) {
        blob.centroid_px += cv::Point2d(p) / n;
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        bottom = std::max(bottom, p.y);
      }
      blob.bounds_px = {left, y0, right - left + 1, bottom - y0 + 1};
      for (const cv::Point& p : pixels) {
        const cv::Point2d d = cv::Point2d(p) - blob.centroid_px;
        blob.moment_xx_px2 += d.x * d.x / n;
        blob.moment_yy_px2 += d.y * d.y / n;
        blob.moment_xy_px2 += d.x * d.y / n;
      }
      blob.moment_xx_px2 += 1.0 / 12;
      blob.moment_yy_px2 += 1.0 / 12;
      blobs.push_back(blob);
    }
  }
  return blobs;
}

void expect_same(const Blob& found, const Blob& expected) {
  constexpr double kRounding = 1e-9;
  EXPECT_EQ(found.label, expected.label);
  EXPECT_EQ(found.area_px, expected.area_px);
  EXPECT_EQ(found.bounds_px, expected.bounds_px);
  EXPECT_NEAR(found.centroid_px.x, expected.centroid_px.x, kRounding);
  EXPECT_NEAR(found.centroid_px.y, expected.centroid_px.y, kRounding);
  EXPECT_NEAR(found.moment_xx_px2, expected.moment_xx_px2, kRounding);
  EXPECT_NEAR(found.moment_yy_px2, expected.moment_yy_px2, kRounding);
  EXPECT_NEAR(found.moment_xy_px2, expected.moment_xy_px2, kRounding);
}

void expect_same_as_flood_fill(const cv::Mat& labels) {
  const std::vector<Blob> found = blobs_of(labels, {.max_blobs = 1'000'000});
  const std::vector<Blob> expected = flood_fill_blobs(labels);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected[i]);
}

RC_GTEST_PROP(BlobExtractor, AgreesWithFloodFillOnRandomLabels, ()) {
  const int width = *rc::gen::inRange(1, 24);
  const int height = *rc::gen::inRange(1, 24);
  const int colors = *rc::gen::inRange(1, 4);
  cv::Mat labels(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      labels.at<Label>(y, x) = static_cast<Label>(*rc::gen::inRange(0, colors + 1));
    }
  }
  expect_same_as_flood_fill(labels);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(BlobExtractor, AgreesWithFloodFillOnNoiseOfOddSize) {
  cv::RNG random(7);
  for (const int colors : {1, 2, 9}) {
    cv::Mat labels(97, 131, CV_8UC1);
    random.fill(labels, cv::RNG::UNIFORM, 0, colors + 1);
    expect_same_as_flood_fill(labels);
  }
}

/// The picture that is left when the runs shorter than `shortest_px` are wiped out.
cv::Mat without_runs_below(const cv::Mat& labels, int shortest_px) {
  std::vector<maggic::Run> runs = runs_of(labels);
  std::erase_if(runs, [&](const maggic::Run& run) { return run.end - run.begin < shortest_px; });
  cv::Mat left;
  draw_runs(runs, labels.size(), left);
  return left;
}

RC_GTEST_PROP(BlobExtractor, AgreesWithFloodFillOfTheLongRunsWhenThereAreTooMany, ()) {
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 12);
  cv::Mat labels(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const int end = std::min(width, x + *rc::gen::inRange(1, 6));
      labels(cv::Rect(x, y, end - x, 1)).setTo(*rc::gen::inRange(0, 3));
      x = end;
    }
  }
  const std::vector<maggic::Run> runs = runs_of(labels);
  const auto max_runs = *rc::gen::inRange<std::size_t>(1, 2 + runs.size());
  std::vector<Blob> found;
  const BlobExtractor::LeftOut left_out =
      BlobExtractor().extract(runs, {.max_runs = max_runs}, found);
  RC_ASSERT((left_out.runs_shorter_than_px > 1) == (runs.size() > max_runs));
  const std::vector<Blob> expected =
      flood_fill_blobs(without_runs_below(labels, left_out.runs_shorter_than_px));
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected[i]);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(BlobExtractor, GivesABoxAmongNoiseAsIfItWereAlone) {
  cv::Mat labels(200, 300, CV_8UC1);
  cv::RNG(3).fill(labels, cv::RNG::UNIFORM, 0, 5);
  const cv::Rect box(120, 80, 30, 20);
  labels(box + cv::Size(2, 2) - cv::Point(1, 1)).setTo(kBackground);
  labels(box).setTo(4);
  std::vector<Blob> found;
  const BlobExtractor::LeftOut left_out =
      BlobExtractor().extract(runs_of(labels), {.min_area_px = 100.0, .max_runs = 100}, found);
  EXPECT_GT(left_out.runs_shorter_than_px, 2);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].bounds_px, box);
  EXPECT_EQ(found[0].area_px, box.area());
}

TEST(BlobExtractor, JoinsDiagonalNeighbours) {
  EXPECT_EQ(blobs_of(picture({"100", "010", "001"})).size(), 1U);
  EXPECT_EQ(blobs_of(picture({"001", "010", "100"})).size(), 1U);
}

TEST(BlobExtractor, TakesACheckerboardForTwoInterwovenBlobs) {
  cv::Mat labels(64, 63, CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels.at<Label>(y, x) = static_cast<Label>(1 + (x + y) % 2);
    }
  }
  const std::vector<Blob> blobs = blobs_of(labels);
  ASSERT_EQ(blobs.size(), 2U);
  EXPECT_EQ(blobs[0].area_px + blobs[1].area_px, 64 * 63);
}

TEST(BlobExtractor, KeepsDifferentLabelsApart) {
  EXPECT_EQ(blobs_of(picture({"12", "21"})).size(), 2U);
  EXPECT_EQ(blobs_of(picture({"1122", "1122"})).size(), 2U);
}

TEST(BlobExtractor, DoesNotJoinAcrossAnEmptyRow) {
  EXPECT_EQ(blobs_of(picture({"111", "000", "111"})).size(), 2U);
}

TEST(BlobExtractor, JoinsArmsThatMeetBelow) {
  EXPECT_EQ(blobs_of(picture({"10101", "10101", "11111"})).size(), 1U);
}

TEST(BlobExtractor, GivesOnePixelItsPlaceAndAUnitSquaresMoments) {
  const std::vector<Blob> blobs = blobs_of(picture({"3"}));
  ASSERT_EQ(blobs.size(), 1U);
  Blob expected;
  expected.label = 3;
  expected.area_px = 1;
  expected.bounds_px = {0, 0, 1, 1};
  expected.moment_xx_px2 = expected.moment_yy_px2 = 1.0 / 12;
  expect_same(blobs[0], expected);
}

TEST(BlobExtractor, ReadsTheMomentsOfABoxFromItsSides) {
  cv::Mat labels = cv::Mat::zeros(40, 50, CV_8UC1);
  labels(cv::Rect(11, 5, 7, 30)).setTo(4);
  const std::vector<Blob> blobs = blobs_of(labels);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_DOUBLE_EQ(blobs[0].moment_xx_px2, 7.0 * 7.0 / 12);
  EXPECT_DOUBLE_EQ(blobs[0].moment_yy_px2, 30.0 * 30.0 / 12);
  EXPECT_DOUBLE_EQ(blobs[0].moment_xy_px2, 0.0);
  EXPECT_EQ(blobs[0].centroid_px, cv::Point2d(14.0, 19.5));
}

TEST(BlobExtractor, KeepsItsDigitsInTheFarCornerOfTheLargestFrame) {
  std::vector<Blob> blobs;
  const std::vector<maggic::Run> runs{{65533, 65530, 65535, 1}, {65534, 65530, 65535, 1}};
  BlobExtractor().extract(runs, {}, blobs);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].centroid_px, cv::Point2d(65532.0, 65533.5));
  EXPECT_DOUBLE_EQ(blobs[0].moment_xx_px2, 25.0 / 12);
  EXPECT_DOUBLE_EQ(blobs[0].moment_yy_px2, 4.0 / 12);
}

TEST(BlobExtractor, CountsTheLargestFrameExactly) {
  std::vector<maggic::Run> runs;
  for (std::uint16_t y = 0; y < 65535; ++y) runs.push_back({y, 0, 65535, 2});
  std::vector<Blob> blobs;
  BlobExtractor().extract(runs, {.max_runs = runs.size()}, blobs);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].centroid_px, cv::Point2d(32767.0, 32767.0));
  EXPECT_DOUBLE_EQ(blobs[0].moment_xx_px2, 65535.0 * 65535.0 / 12);
  EXPECT_DOUBLE_EQ(blobs[0].moment_xy_px2, 0.0);
}

TEST(BlobExtractor, FindsNothingWithoutRuns) {
  std::vector<Blob> blobs(3);
  EXPECT_EQ(BlobExtractor().extract({}, {}, blobs).blobs, 0U);
  EXPECT_TRUE(blobs.empty());
}

TEST(BlobExtractor, LeavesOutBlobsBeyondTheAreaLimits) {
  const cv::Mat labels = picture({"1022203333", "0000000000"});
  const std::vector<Blob> blobs = blobs_of(labels, {.min_area_px = 2.0, .max_area_px = 3.0});
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].label, 2);
}

TEST(BlobExtractor, KeepsTheLargestInTheirOrderWhenTheCapIsReached) {
  const std::vector<maggic::Run> runs = runs_of(picture({"1022203330440"}));
  BlobExtractor extractor;
  std::vector<Blob> blobs;
  EXPECT_EQ(extractor.extract(runs, {.max_blobs = 2}, blobs).blobs, 2U);
  ASSERT_EQ(blobs.size(), 2U);
  EXPECT_EQ(blobs[0].label, 2);
  EXPECT_EQ(blobs[1].label, 3);
}

TEST(BlobExtractor, KeepsTheFirstOfEquallyLargeOnesWhenTheCapIsReached) {
  const std::vector<maggic::Run> runs = runs_of(picture({"1022033044405505"}));
  std::vector<Blob> blobs;
  EXPECT_EQ(BlobExtractor().extract(runs, {.max_blobs = 3}, blobs).blobs, 3U);
  ASSERT_EQ(blobs.size(), 3U);
  EXPECT_EQ(blobs[0].label, 2);
  EXPECT_EQ(blobs[1].label, 3);
  EXPECT_EQ(blobs[2].label, 4);
}

TEST(BlobExtractor, CountsOnlyBlobsWithinTheLimitsAsLeftOut) {
  const std::vector<maggic::Run> runs = runs_of(picture({"1022203330440"}));
  BlobExtractor extractor;
  std::vector<Blob> blobs;
  EXPECT_EQ(extractor.extract(runs, {.min_area_px = 2.0, .max_blobs = 2}, blobs).blobs, 1U);
}

TEST(BlobExtractor, ForgetsTheFrameBefore) {
  BlobExtractor extractor;
  std::vector<Blob> blobs;
  extractor.extract(runs_of(picture({"111", "020", "333"})), {}, blobs);
  extractor.extract(runs_of(picture({"01"})), {}, blobs);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].centroid_px, cv::Point2d(1.0, 0.0));
}

}  // namespace
}  // namespace maggic
