/// Borders between colours, checked with the segmenters that draw them.

#include "maggic/border_check.hpp"

#include <string>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "maggic/pipeline_builder.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A pipeline with the given segmenter, and what it says of pictures.
class Bench {
 public:
  explicit Bench(const std::string& segmenter)
      : built_(build_pipeline(
            parse_document("source: synthetic_match\nnormalizer: none\ntracker: two_tag\n"
                           "blobs: {min_area_mm2: 0, max_area_mm2: 1.0e+9}\n"
                           "segmenter: {" +
                               segmenter + "}\n",
                           "bench.yaml"),
            testing::registry(), reporter_)) {}

  std::vector<DoubtfulBorder> look_at(const cv::Mat3b& bgr, const BorderLimits& limits = {}) {
    FrameResult result;
    result.frame.bgr = bgr;
    built_.pipeline->process(result);
    BlobColors colors;
    colors.offer(result);
    return find_doubtful_borders(*built_.pipeline, colors, limits);
  }
  std::vector<std::string> sentences(const cv::Mat3b& bgr) {
    std::vector<std::string> all;
    for (const DoubtfulBorder& border : look_at(bgr)) {
      all.push_back(border.to_string(built_.pipeline->palette()));
    }
    return all;
  }

 private:
  testing::RecordingReporter reporter_;
  BuiltPipeline built_;
};

/// Rows of 100 pixels, one a hue of 1/256 of the circle, fully saturated.
cv::Mat3b rows_of_hues(const std::vector<int>& hues) {
  cv::Mat3b hsv(static_cast<int>(hues.size()), 100);
  for (int row = 0; row < hsv.rows; ++row) {
    const auto hue = static_cast<std::uint8_t>(hues[static_cast<std::size_t>(row)]);
    hsv.row(row).setTo(cv::Scalar(hue, 255, 200));
  }
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR_FULL);
  return bgr;
}

TEST(BorderCheck, FindsTheHueAtWhichPivotsPartAColor) {
  // Between 20 and 41 the border lies at 30.5: of the hues shown 29, 30, 31, 32 are within 2 of it.
  Bench bench("hue_pivots: {pivots: {orange: 20, yellow: 41}}");
  EXPECT_THAT(bench.sentences(rows_of_hues({27, 28, 29, 30, 31, 32, 33, 34})),
              ElementsAre("the border between orange and yellow at hue 31 cuts through 50 % of "
                          "orange's and 50 % of yellow's pixels"));
}

TEST(BorderCheck, IsSilentWhereNoColorIsNear) {
  Bench bench("hue_pivots: {pivots: {orange: 20, yellow: 41}}");
  EXPECT_THAT(bench.sentences(rows_of_hues({15, 20, 25, 28, 33, 36, 41, 50})), IsEmpty());
}

TEST(BorderCheck, BrightnessMovesNoHueOverAPivotsBorder) {
  Bench bench("hue_pivots: {pivots: {orange: 20, yellow: 41}}");
  BorderLimits limits;
  limits.hue_steps = 0;
  EXPECT_THAT(bench.look_at(rows_of_hues({27, 28, 29, 32, 33, 34}), limits), IsEmpty());
}

TEST(BorderCheck, FindsBordersInBrightnessToo) {
  // Red of value 100 and 102 is Y 29 and 30: the boxes part it there, whatever its hue.
  Bench bench(
      "yuv_boxes: {boxes: {red: {y: [0, 29], u: [0, 255], v: [0, 255]}, "
      "orange: {y: [30, 255], u: [0, 255], v: [0, 255]}}}");
  cv::Mat3b bgr(10, 100, cv::Vec3b(0, 0, 98));
  bgr.rowRange(5, 10).setTo(cv::Scalar(0, 0, 103));
  const auto borders = bench.look_at(bgr);
  ASSERT_THAT(borders, SizeIs(1));
  EXPECT_EQ(borders[0].kind, DoubtfulBorder::Kind::kCut);
  EXPECT_EQ(borders[0].hue, std::nullopt);
  EXPECT_DOUBLE_EQ(borders[0].share_of_first, 1.0);
  EXPECT_DOUBLE_EQ(borders[0].share_of_second, 1.0);
}

TEST(BorderCheck, FindsBoxesThatOverlapWhereThereAreColors) {
  Bench bench(
      "yuv_boxes: {boxes: {blue: {y: [0, 255], u: [140, 255], v: [0, 255]}, "
      "cyan: {y: [0, 120], u: [130, 255], v: [0, 255]}}}");
  cv::Mat3b bgr(10, 100, cv::Vec3b(200, 20, 20));        // in both boxes
  bgr.rowRange(5, 10).setTo(cv::Scalar(255, 150, 150));  // in the box of blue alone
  EXPECT_THAT(bench.sentences(bgr),
              ElementsAre("50 % of blue's pixels lie in the region of cyan too, and are blue only "
                          "because it is listed first"));
}

TEST(BorderCheck, AFewPixelsAreNoReason) {
  Bench bench("hue_pivots: {pivots: {orange: 20, yellow: 41}}");
  BorderLimits limits;
  limits.min_pixels = 401;
  EXPECT_THAT(bench.look_at(rows_of_hues({27, 28, 29, 30, 31, 32, 33, 34}), limits), IsEmpty());
  limits.min_pixels = 400;
  limits.min_share = 0.51;
  EXPECT_THAT(bench.look_at(rows_of_hues({27, 28, 29, 30, 31, 32, 33, 34}), limits), IsEmpty());
}

}  // namespace
}  // namespace maggic
