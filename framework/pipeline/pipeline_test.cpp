#include "maggic/pipeline.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using fakes::Rig;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

cv::Mat red_square(int width, int height) {
  cv::Mat picture(height, width, CV_8UC3, cv::Scalar(10, 10, 10));
  picture(cv::Rect(2, 1, 3, 2)).setTo(cv::Scalar(0, 0, 200));
  return picture;
}

TEST(Pipeline, TurnsPixelsIntoBlobs) {
  Rig rig(0);
  FrameResult result;
  result.frame.bgr = red_square(9, 7);
  ASSERT_EQ(rig.built.pipeline->process(result), FrameOutcome::kProcessed);
  ASSERT_THAT(result.blobs, SizeIs(1));
  EXPECT_EQ(result.blobs[0].area_px, 6);
  EXPECT_DOUBLE_EQ(result.blobs[0].centroid_px.x, 3.0);
  EXPECT_DOUBLE_EQ(result.blobs[0].centroid_px.y, 1.5);
}

TEST(Pipeline, StagesThatNeedThePictureGiveTheSameAsTheCompiledTable) {
  Rig compiled(0);
  Rig per_frame(0, 1, true);
  EXPECT_NE(compiled.built.pipeline->color_table(), nullptr);
  EXPECT_EQ(per_frame.built.pipeline->color_table(), nullptr);
  cv::Mat noise(33, 47, CV_8UC3);
  cv::randu(noise, 0, 256);
  FrameResult a;
  FrameResult b;
  a.frame.bgr = noise;
  b.frame.bgr = noise;
  compiled.built.pipeline->process(a);
  per_frame.built.pipeline->process(b);
  EXPECT_EQ(a.runs, b.runs);
}

TEST(Pipeline, TakesFramesOfChangingSizeAsTheyCome) {
  Rig rig(0);
  for (const cv::Size size : {cv::Size(9, 7), cv::Size(640, 480), cv::Size(5, 3)}) {
    FrameResult result;
    result.frame.bgr = red_square(size.width, size.height);
    ASSERT_EQ(rig.built.pipeline->process(result), FrameOutcome::kProcessed);
    EXPECT_EQ(rig.built.pipeline->field()->frame_size_px(), size);
    EXPECT_THAT(result.blobs, SizeIs(1));
  }
}

TEST(Pipeline, ConvertsOtherPictureTypes) {
  Rig rig(0);
  for (const int type : {CV_8UC1, CV_8UC4, CV_16UC1, CV_16UC3}) {
    FrameResult result;
    result.frame.bgr = cv::Mat(4, 4, type, cv::Scalar::all(60000));
    EXPECT_EQ(rig.built.pipeline->process(result), FrameOutcome::kProcessed) << type;
    EXPECT_THAT(result.blobs, SizeIs(1)) << type;
  }
}

TEST(Pipeline, ASinglePixelIsAPicture) {
  Rig rig(0);
  FrameResult result;
  result.frame.bgr = cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 255));
  EXPECT_EQ(rig.built.pipeline->process(result), FrameOutcome::kProcessed);
  EXPECT_THAT(result.blobs, SizeIs(1));
}

TEST(Pipeline, ASkippedFrameHoldsNothingOfTheLastOne) {
  Rig rig(0);
  FrameResult result;
  result.frame.bgr = red_square(9, 7);
  rig.built.pipeline->process(result);
  result.frame.bgr = cv::Mat();
  EXPECT_EQ(rig.built.pipeline->process(result), FrameOutcome::kSkipped);
  EXPECT_THAT(result.blobs, IsEmpty());
}

TEST(Pipeline, AThrowingImageStageIsNamed) {
  struct Throwing : ImageSegmenter {
    void segment(const cv::Mat&, const cv::Mat&, cv::Mat&) override {
      throw std::runtime_error("no model");
    }
  };
  testing::RecordingReporter reporter;
  PipelineParts parts;
  parts.palette = Palette::standard();
  parts.normalizer = fakes::named<Normalizer>("same", std::make_unique<fakes::SameNormalizer>());
  parts.segmenter = fakes::named<Segmenter>("throwing", std::make_unique<Throwing>());
  parts.tracker = fakes::named<Tracker>("hook", std::make_unique<fakes::HookTracker>());
  Pipeline pipeline(std::move(parts), reporter);
  FrameResult result;
  result.frame.sequence = 12;
  result.frame.bgr = red_square(9, 7);
  try {
    pipeline.process(result);
    FAIL();
  } catch (const StageError& e) {
    EXPECT_STREQ(e.what(), "segmenter 'throwing' failed at frame 12: no model");
  }
}

}  // namespace
}  // namespace maggic
