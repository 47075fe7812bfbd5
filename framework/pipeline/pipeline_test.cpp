#include "maggic/pipeline.hpp"

#include <chrono>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using fakes::Rig;
using ::testing::ElementsAre;
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

TEST(Pipeline, SeesADimmedPictureAsTheCalibrationDid) {
  LightParameters light;
  light.follow = true;
  light.reference_rgb = {10.0, 10.0, 10.0};  // the floor of red_square
  for (const bool image_stages : {false, true}) {
    Rig rig(0, 1, image_stages, {}, light);
    FrameResult result;
    result.frame.bgr = red_square(64, 48);
    rig.built.pipeline->process(result);
    EXPECT_EQ(rig.built.pipeline->channel_gains(), nullptr);
    const std::vector<maggic::Run> in_full_light = result.runs;

    result.frame.captured += std::chrono::minutes(1);
    result.frame.bgr = red_square(64, 48) * 0.3;
    const cv::Mat as_captured = result.frame.bgr.clone();
    rig.built.pipeline->process(result);
    EXPECT_NE(rig.built.pipeline->channel_gains(), nullptr);
    EXPECT_EQ(result.runs, in_full_light);
    EXPECT_EQ(cv::norm(result.frame.bgr, as_captured, cv::NORM_INF), 0.0);  // sinks show it as it is
  }
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

TEST(Pipeline, LeavesOutTheShortestRunsOfAFrameThatHasTooManyAndSaysSo) {
  Rig rig(0, 1, false, {}, {}, {.min_area_mm2 = 0.0, .max_area_mm2 = 1e9, .max_runs = 2});
  FrameResult result;
  result.frame.bgr = red_square(9, 7);
  rig.built.pipeline->process(result);
  EXPECT_THAT(rig.reporter.messages(), IsEmpty());
  result.frame.bgr.at<cv::Vec3b>(5, 6) = {0, 0, 255};
  rig.built.pipeline->process(result);
  ASSERT_THAT(result.blobs, SizeIs(1));
  EXPECT_EQ(result.blobs[0].area_px, 6);
  EXPECT_THAT(result.runs, SizeIs(3)) << "sinks see what was segmented";
  EXPECT_THAT(rig.reporter.messages(),
              ElementsAre("more runs than blobs.max_runs: those shorter than 2 px were left out"));
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

/// What `process` says of a picture of 640×480 with these stages; empty when nothing.
std::string complaint(std::unique_ptr<Normalizer> normalizer,
                      std::unique_ptr<Segmenter> segmenter) {
  testing::RecordingReporter reporter;
  PipelineParts parts;
  parts.palette = Palette::standard();
  parts.normalizer = fakes::named<Normalizer>("x", std::move(normalizer));
  parts.segmenter = fakes::named<Segmenter>("x", std::move(segmenter));
  parts.tracker = fakes::named<Tracker>("hook", std::make_unique<fakes::HookTracker>());
  Pipeline pipeline(std::move(parts), reporter);
  FrameResult result;
  result.frame.sequence = 12;
  result.frame.bgr = red_square(640, 480);
  try {
    pipeline.process(result);
  } catch (const StageError& e) {
    return e.what();
  }
  return {};
}

struct HookSegmenter : ImageSegmenter {
  std::function<void(cv::Mat&)> hook;
  explicit HookSegmenter(std::function<void(cv::Mat&)> h) : hook(std::move(h)) {}
  void segment(const cv::Mat&, const cv::Mat&, cv::Mat& labels) override { hook(labels); }
};

struct HookNormalizer : ImageNormalizer {
  std::function<void(cv::Mat&)> hook;
  explicit HookNormalizer(std::function<void(cv::Mat&)> h) : hook(std::move(h)) {}
  void normalize(const cv::Mat&, cv::Mat& normalized) override { hook(normalized); }
};

std::string complaint_of_segmenter(std::function<void(cv::Mat&)> hook) {
  return complaint(std::make_unique<fakes::SameNormalizer>(),
                   std::make_unique<HookSegmenter>(std::move(hook)));
}

std::string complaint_of_normalizer(std::function<void(cv::Mat&)> hook) {
  return complaint(std::make_unique<HookNormalizer>(std::move(hook)),
                   std::make_unique<fakes::RedSegmenter>());
}

TEST(Pipeline, AThrowingImageStageIsNamed) {
  EXPECT_EQ(complaint_of_segmenter([](cv::Mat&) { throw std::runtime_error("no model"); }),
            "segmenter 'x' failed at frame 12: no model");
}

TEST(Pipeline, AnImageStagesPictureOfAnotherSizeIsRefused) {
  EXPECT_EQ(complaint_of_segmenter([](cv::Mat& m) { m = cv::Mat::zeros(3, 3, CV_8UC1); }),
            "segmenter 'x' failed at frame 12: it made a label image of 3x3 for a picture of "
            "640x480");
  EXPECT_EQ(complaint_of_normalizer([](cv::Mat& m) { m = cv::Mat::zeros(640, 480, CV_8UC3); }),
            "normalizer 'x' failed at frame 12: it made a normalized picture of 480x640 for a "
            "picture of 640x480");
  EXPECT_THAT(complaint_of_segmenter([](cv::Mat& m) { m.release(); }), HasSubstr("of 0x0 for"));
}

TEST(Pipeline, AnImageStagesPictureOfAnotherTypeIsRefused) {
  EXPECT_EQ(complaint_of_segmenter([](cv::Mat& m) { m = cv::Mat::zeros(m.size(), CV_32SC1); }),
            "segmenter 'x' failed at frame 12: it made a label image of type CV_32SC1, expected "
            "CV_8UC1");
  EXPECT_THAT(complaint_of_normalizer([](cv::Mat& m) { m = cv::Mat::zeros(m.size(), CV_8UC1); }),
              HasSubstr("a normalized picture of type CV_8UC1, expected CV_8UC3"));
  EXPECT_THAT(complaint_of_segmenter([](cv::Mat& m) {
                const int sizes[] = {4, 480, 640};
                m = cv::Mat::zeros(3, sizes, CV_8UC1);
              }),
              HasSubstr("a label image of 3 dimensions, expected 2"));
}

TEST(Pipeline, ALabelBeyondThePaletteIsRefused) {
  const std::size_t size = Palette::standard().size();
  const auto with_label = [](std::size_t label) {
    return [label](cv::Mat& m) {
      m.setTo(0);
      m.at<Label>(479, 639) = static_cast<Label>(label);
    };
  };
  EXPECT_EQ(complaint_of_segmenter(with_label(size - 1)), "");
  EXPECT_EQ(complaint_of_segmenter(with_label(size)),
            fmt::format("segmenter 'x' failed at frame 12: it gave the label {}, expected a label "
                        "below the palette's size {}",
                        size, size));
}

TEST(Pipeline, ARefusedPictureDoesNotHarmTheNextFrame) {
  testing::RecordingReporter reporter;
  int calls = 0;
  PipelineParts parts;
  parts.palette = Palette::standard();
  parts.normalizer = fakes::named<Normalizer>("same", std::make_unique<fakes::SameNormalizer>());
  parts.segmenter =
      fakes::named<Segmenter>("x", std::make_unique<HookSegmenter>([&](cv::Mat& labels) {
                                labels.setTo(0);
                                if (++calls == 1) labels = cv::Mat::zeros(3, 3, CV_8UC1);
                              }));
  parts.tracker = fakes::named<Tracker>("hook", std::make_unique<fakes::HookTracker>());
  Pipeline pipeline(std::move(parts), reporter);
  FrameResult result;
  result.frame.bgr = red_square(9, 7);
  EXPECT_THROW(pipeline.process(result), StageError);
  EXPECT_EQ(pipeline.process(result), FrameOutcome::kProcessed);
}

}  // namespace
}  // namespace maggic
