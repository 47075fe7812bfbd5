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

struct LookOptions {
  bool image_stages = false;
  BlobParameters blobs{.min_area_mm2 = 0.0, .max_area_mm2 = 1e9, .max_runs = 1000};
  FieldParameters field;
  ScanParameters scan;
  int frames = 1;  ///< The answers are for the last.
};

/// What a pipeline of fakes makes of a picture: label 1 (orange) where red is above 127.
class Look {
 public:
  explicit Look(const cv::Mat3b& bgr, const LookOptions& options = {})
      : rig_(0, 0, options.image_stages, options.field, {}, options.blobs, options.scan) {
    result_.frame.bgr = bgr;
    for (int i = 0; i < options.frames; ++i) rig_.built.pipeline->process(result_);
  }

  std::string answer(cv::Point pixel_px, std::string_view stage) const {
    for (const StageAnswer& answer : explain_point(*rig_.built.pipeline, result_, pixel_px)) {
      if (answer.stage == stage) return answer.text;
    }
    return {};
  }
  std::string stages(cv::Point pixel_px) const {
    std::string names;
    for (const StageAnswer& answer : explain_point(*rig_.built.pipeline, result_, pixel_px)) {
      names += (names.empty() ? "" : " ") + answer.stage;
    }
    return names;
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
  const Look look(red_square(), {.image_stages = true});
  EXPECT_EQ(look.answer({1, 2}, "normalized"), "RGB 200 0 0 by same");
  EXPECT_THAT(look.answer({1, 2}, "label"),
              StartsWith("orange: red judges the picture as a whole and gives no reason"));
  EXPECT_THAT(look.answer({1, 2}, "blob"), StartsWith("16 px, "));
  EXPECT_THAT(look.answer({5, 5}, "label"), HasSubstr("background"));
}

TEST(PointExplanation, NamesTheCapThatLeftAShortRunOut) {
  cv::Mat3b bgr = red_square();
  bgr(cv::Rect(8, 6, 1, 2)).setTo(cv::Scalar(0, 0, 200));
  const Look look(bgr, {.blobs = {.min_area_mm2 = 0.0, .max_area_mm2 = 1e9, .max_runs = 4}});
  EXPECT_EQ(look.answer({8, 6}, "label"), "orange");
  EXPECT_EQ(look.answer({8, 6}, "blob"),
            "dropped: the frame has 6 runs (stretches of one colour along a row), more than "
            "blobs.max_runs 4, and those shorter than 2 px were left out");
  EXPECT_EQ(look.answer({8, 6}, "tracker"), "");
  EXPECT_THAT(look.answer({1, 2}, "blob"),
              AllOf(StartsWith("16 px, "), HasSubstr("those shorter than 2 px were left out")));
  EXPECT_EQ(look.answer({1, 2}, "tracker"), "hook gives no reasons");
}

/// A 3v3 field of 150 × 130 px, 10 mm a pixel, in the middle of a picture, seen from straight above
/// by a camera so high that height makes no difference to the millimetre.
FieldParameters small_field() {
  FieldParameters field;
  field.corners_px = {{25, 15}, {175, 15}, {175, 145}, {25, 145}};
  field.camera_height_mm = 1e6;
  return field;
}

TEST(PointExplanation, NamesTheMarginBeyondWhichNothingIsLookedAt) {
  const cv::Mat3b red(160, 200, cv::Vec3b(0, 0, 200));
  const Look look(red, {.field = small_field(), .scan = {.margin_mm = 50.0}});
  EXPECT_EQ(look.answer({10, 80}, "scan"),
            "not looked at: beyond the field: 150 mm outside the lines, scan.margin_mm is 50\n"
            "scan.margin_mm 150 would take it in; if it is nearer to the field than that, "
            "field.corners_px are not its corners");
  EXPECT_EQ(look.stages({10, 80}), "pixel scan");
  EXPECT_EQ(look.stages({22, 80}), "pixel normalized label blob tracker");
  const Look wider(red, {.field = small_field(), .scan = {.margin_mm = 150.0}});
  EXPECT_EQ(wider.stages({10, 80}), "pixel normalized label blob tracker");
}

TEST(PointExplanation, OffersNoMarginThatAPipelineCannotHave) {
  FieldParameters field = small_field();
  for (cv::Point2d& corner : field.corners_px) corner.x += 2000.0;
  const Look look(red_square(), {.field = field});
  EXPECT_EQ(look.answer({1, 1}, "scan"),
            "not looked at: beyond the field: more than 10000 mm outside the lines, scan.margin_mm "
            "is 200\nif it is nearer to the field than that, field.corners_px are not its corners");
}

/// A look at the fifth frame of a predicted search that sees nothing it knows. Of four turns it is
/// the first, and has the top quarter's rows and a robot's breadth, 130 mm, more: rows up to 91.
class FirstTurn : public ::testing::TestWithParam<bool> {
 protected:
  Look look(const BlobParameters& blobs = {.min_area_mm2 = 0.0, .max_area_mm2 = 1e9}) const {
    FieldParameters field;
    field.camera_height_mm = 1e6;
    return Look(bgr_, {.image_stages = GetParam(),
                       .blobs = blobs,
                       .field = field,
                       .scan = {.search = ScanParameters::Search::kPredicted, .unseen_frames = 4},
                       .frames = 5});
  }
  void paint(const cv::Rect& box_px) { bgr_(box_px).setTo(cv::Scalar(0, 0, 200)); }

 private:
  cv::Mat3b bgr_{cv::Mat3b::zeros(260, 300)};  // 5 mm a pixel
};

TEST_P(FirstTurn, OfAPredictedSearchSaysWhereItDidNotLook) {
  paint({100, 200, 10, 10});
  const Look first_turn = look();
  EXPECT_EQ(first_turn.answer({105, 205}, "scan"),
            "not looked at in this frame: with scan.search: predicted that is only round what was "
            "seen last, and one part of the field in turn\n"
            "this place's turn comes within scan.unseen_frames, 4 frames; scan.search: full looks "
            "at all of it in every frame");
  EXPECT_EQ(first_turn.stages({105, 205}), "pixel scan");
  EXPECT_EQ(first_turn.stages({105, 91}), "pixel normalized label");
  EXPECT_EQ(first_turn.stages({105, 92}), "pixel scan");
}

TEST_P(FirstTurn, DoesNotExplainABlobItCutByLimits) {
  paint({100, 86, 10, 10});
  for (const BlobParameters& blobs : {BlobParameters{.min_area_mm2 = 0.0, .max_area_mm2 = 1e9},
                                      BlobParameters{.min_area_mm2 = 2000.0, .max_area_mm2 = 1e9},
                                      BlobParameters{.min_area_mm2 = 0.0, .max_area_mm2 = 1.0}}) {
    const Look first_turn = look(blobs);
    EXPECT_EQ(
        first_turn.answer({105, 88}, "blob"),
        "60 px of it were looked at in this frame, around 104.5,88.5\n"
        "dropped: with scan.search: predicted, as it may go on where this frame was not "
        "looked at\n"
        "a tag or a ball is seen whole within scan.unseen_frames, 4 frames; scan.search: full "
        "looks at all of the field in every frame");
    EXPECT_EQ(first_turn.stages({105, 88}), "pixel normalized label blob");
  }
}

TEST_P(FirstTurn, ExplainsABlobThatIsWholeByTheLimitThatDroppedIt) {
  paint({100, 40, 10, 10});
  const Look first_turn = look({.min_area_mm2 = 5000.0, .max_area_mm2 = 1e9});
  EXPECT_THAT(first_turn.answer({105, 45}, "blob"),
              HasSubstr("dropped: smaller than blobs.min_area_mm2"));
}

TEST_P(FirstTurn, SaysWhenTheTrackerWasNotShownAllRoundABlob) {
  paint({100, 20, 10, 10});
  paint({100, 75, 10, 10});
  const Look first_turn = look();
  EXPECT_EQ(first_turn.answer({105, 25}, "tracker"), "hook gives no reasons");
  EXPECT_EQ(first_turn.answer({105, 80}, "tracker"),
            "hook gives no reasons\n"
            "not all within 130 mm of it was looked at in this frame (scan.search: predicted); all "
            "is seen together within scan.unseen_frames, 4 frames");
}

INSTANTIATE_TEST_SUITE_P(Stages, FirstTurn, ::testing::Bool(), [](const auto& stages) {
  return stages.param ? "OfThePicture" : "OfColors";
});

TEST(PointExplanation, RefusesAPointOutsideOfThePicture) {
  const Look look(red_square());
  for (const cv::Point outside : {cv::Point(10, 0), cv::Point(0, 8), cv::Point(-1, 3)}) {
    EXPECT_THROW(look.answer(outside, "pixel"), std::out_of_range);
  }
  EXPECT_NO_THROW(look.answer({9, 7}, "pixel"));
}

TEST(PointExplanation, StagesThatJudgeThePictureHaveNoBorders) {
  const Look look(red_square(), {.image_stages = true});
  BlobColors colors;
  colors.offer(look.result());
  EXPECT_THAT(find_doubtful_borders(look.pipeline(), colors), IsEmpty());
}

}  // namespace
}  // namespace maggic
