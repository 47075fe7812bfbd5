#include "maggic/point_explanation.hpp"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/border_check.hpp"
#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// What a pipeline of fakes makes of a picture: label 1 (orange) where red is above 127.
class Look {
 public:
  explicit Look(const cv::Mat3b& bgr, bool image_stages = false, int max_runs = 1000)
      : rig_(0, 0, image_stages, {}, {},
             {.min_area_mm2 = 0.0, .max_area_mm2 = 1e9, .max_runs = max_runs}) {
    result_.frame.bgr = bgr;
    rig_.built.pipeline->process(result_);
  }

  std::string answer(cv::Point pixel_px, std::string_view stage) const {
    for (const StageAnswer& answer : explain_point(*rig_.built.pipeline, result_, pixel_px)) {
      if (answer.stage == stage) return answer.text;
    }
    return {};
  }
  const Pipeline& pipeline() const { return *rig_.built.pipeline; }
  const FrameResult& result() const { return result_; }

 private:
  fakes::Rig rig_;
  FrameResult result_;
};

/// Black, with a red square of 4×4 pixels at its top left.
cv::Mat3b red_square() {
  cv::Mat3b bgr(8, 10, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(0, 0, 4, 4)).setTo(cv::Scalar(0, 0, 200));
  return bgr;
}

TEST(PointExplanation, AnswersForEveryStageThatHadThePixel) {
  const Look look(red_square());
  EXPECT_EQ(look.answer({1, 2}, "pixel"), "RGB 200 0 0, hue 0, saturation 255, value 200");
  EXPECT_EQ(look.answer({1, 2}, "normalized"), "RGB 200 0 0 by same");
  EXPECT_EQ(look.answer({1, 2}, "label"), "orange");
  EXPECT_THAT(look.answer({1, 2}, "blob"), StartsWith("16 px, "));
  EXPECT_EQ(look.answer({1, 2}, "tracker"), "hook gives no reasons");
}

TEST(PointExplanation, StopsAtTheSegmenterOnBackground) {
  const Look look(red_square());
  EXPECT_EQ(look.answer({5, 5}, "label"),
            "background\nthe nearest coloured pixel is orange at 3,3");
  EXPECT_THAT(look.answer({5, 5}, "blob"), IsEmpty());
  EXPECT_THAT(look.answer({5, 5}, "tracker"), IsEmpty());
}

TEST(PointExplanation, LooksUpWhatStagesMadeOfAWholePicture) {
  const Look look(red_square(), true);
  EXPECT_EQ(look.answer({1, 2}, "normalized"), "RGB 200 0 0 by same");
  EXPECT_THAT(look.answer({1, 2}, "label"),
              StartsWith("orange: red judges the picture as a whole and gives no reason"));
  EXPECT_THAT(look.answer({1, 2}, "blob"), StartsWith("16 px, "));
  EXPECT_THAT(look.answer({5, 5}, "label"), HasSubstr("background"));
}

TEST(PointExplanation, NamesTheCapThatLeftAShortRunOut) {
  cv::Mat3b bgr = red_square();
  bgr(cv::Rect(8, 6, 1, 2)).setTo(cv::Scalar(0, 0, 200));
  const Look look(bgr, false, 4);
  EXPECT_EQ(look.answer({8, 6}, "label"), "orange");
  EXPECT_EQ(look.answer({8, 6}, "blob"),
            "dropped: the frame has 6 runs (stretches of one colour along a row), more than "
            "blobs.max_runs 4, and those shorter than 2 px were left out");
  EXPECT_EQ(look.answer({8, 6}, "tracker"), "");
  EXPECT_THAT(look.answer({1, 2}, "blob"),
              AllOf(StartsWith("16 px, "), HasSubstr("those shorter than 2 px were left out")));
  EXPECT_EQ(look.answer({1, 2}, "tracker"), "hook gives no reasons");
}

TEST(PointExplanation, RefusesAPointOutsideOfThePicture) {
  const Look look(red_square());
  for (const cv::Point outside : {cv::Point(10, 0), cv::Point(0, 8), cv::Point(-1, 3)}) {
    EXPECT_THROW(look.answer(outside, "pixel"), std::out_of_range);
  }
  EXPECT_NO_THROW(look.answer({9, 7}, "pixel"));
}

TEST(PointExplanation, StagesThatJudgeThePictureHaveNoBorders) {
  const Look look(red_square(), true);
  BlobColors colors;
  colors.offer(look.result());
  EXPECT_THAT(find_doubtful_borders(look.pipeline(), colors), IsEmpty());
}

}  // namespace
}  // namespace maggic
