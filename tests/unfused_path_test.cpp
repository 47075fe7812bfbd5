/// The frame path against the plainest one there is: every pixel through normalizer and segmenter,
/// rows read from left to right. On every vector instruction set and for several threads; and a
/// search led by predictions against a full one. Footage is not part of the project; without
/// `../shared/footage` the tests on it skip.

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "maggic/pipeline_builder.hpp"
#include "maggic/run_scanner.hpp"
#include "maggic/simd_target.hpp"
#include "maggic/testing.hpp"
#include "scan/plain_runs_for_tests.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;

const fs::path kProject = MAGGIC_SOURCE_DIR;
const fs::path kFootage = kProject / ".." / "shared" / "footage";

struct Scene {
  const char* name;
  const char* pipeline;
  const char* media = nullptr;  ///< Null: the pipeline's own synthetic match.
  int frames = 30;
};

std::string name_of(const ::testing::TestParamInfo<Scene>& scene) { return scene.param.name; }

BuiltPipeline build(const Scene& scene, std::vector<std::string> assignments,
                    testing::RecordingReporter& reporter) {
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (std::string(scene.pipeline) + ".yaml");
  if (scene.media != nullptr) {
    request.calibration =
        kProject / "pipelines" / "calibrations" / (fs::path(scene.media).stem().string() + ".yaml");
    const bool is_still = fs::path(scene.media).extension() == ".jpg";
    const std::string path = (kFootage / scene.media).string();
    request.source = parse_document(is_still ? fmt::format("images: {{path: '{}'}}", path)
                                             : fmt::format("video: {{path: '{}'}}", path),
                                    "source");
  }
  request.assignments = std::move(assignments);
  return build_pipeline(request, testing::registry(), reporter);
}

/// Labels by the stages themselves, without a table.
cv::Mat labels_by_stages(const Pipeline& pipeline, const cv::Mat& bgr) {
  const auto& normalizer = dynamic_cast<const ColorNormalizer&>(*pipeline.parts().normalizer.stage);
  const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*pipeline.parts().segmenter.stage);
  cv::Mat balanced = bgr;
  if (pipeline.channel_gains() != nullptr) apply(*pipeline.channel_gains(), bgr, balanced);
  std::vector<cv::Mat1b> in;
  cv::split(balanced, in);
  const std::size_t size = bgr.total();
  std::vector<std::vector<std::uint8_t>> out(3, std::vector<std::uint8_t>(size));
  const ColorBatch original{{in[0].data, size}, {in[1].data, size}, {in[2].data, size}};
  const MutableColorBatch normalized{out[0], out[1], out[2]};
  cv::Mat labels(bgr.size(), CV_8UC1);
  normalizer.normalize(original, normalized);
  segmenter.segment(original, normalized.as_const(), {labels.data, size});
  return labels;
}

/// Every digit of everything.
std::string text_of(const Detections& detections) {
  std::string text;
  const auto add = [&](const auto& object) {
    text += fmt::format("{} {} {} {} {} {} {} ", object.position_mm.x, object.position_mm.y,
                        object.velocity_mm_s.x, object.velocity_mm_s.y, object.centroid_px.x,
                        object.centroid_px.y, object.confidence);
    text += name_of(object.state);
  };
  if (detections.ball) add(*detections.ball);
  for (const RobotDetection& robot : detections.robots) {
    text += fmt::format("\n{} {} {} {} {}: ", name_of(robot.team), robot.id, robot.heading_rad,
                        robot.angular_velocity_rad_s, robot.tags.size());
    add(robot);
  }
  return text;
}

class FramePath : public ::testing::TestWithParam<Scene> {
 protected:
  void SetUp() override {
    if (GetParam().media != nullptr && !fs::exists(kFootage / GetParam().media)) {
      GTEST_SKIP() << "no footage at " << kFootage;
    }
  }
  void TearDown() override { use_simd_target({}); }
};

TEST_P(FramePath, FindsTheRunsOfThePlainestPathOnEveryMachine) {
  testing::RecordingReporter reporter;
  BuiltPipeline built = build(GetParam(), {}, reporter);
  const Pipeline& pipeline = *built.pipeline;
  built.source.stage->open();
  RunScanner one;
  RunScanner three(3);
  one.set_table(*pipeline.color_table());
  three.set_table(*pipeline.color_table());
  FrameResult result;
  std::vector<maggic::Run> runs;
  for (int frame = 0; frame < GetParam().frames; ++frame) {
    if (built.source.stage->read(result.frame) != ReadStatus::kFrame) break;
    ASSERT_EQ(built.pipeline->process(result), FrameOutcome::kProcessed);
    const ScanArea& area = pipeline.field_area();
    const std::vector<maggic::Run> expected =
        plain_runs(labels_by_stages(pipeline, result.frame.bgr), area);
    ASSERT_FALSE(expected.empty());
    for (const std::string& target : simd_targets()) {
      use_simd_target(target);
      one.scan(result.frame.bgr, area, pipeline.channel_gains(), runs);
      ASSERT_EQ(runs, expected) << target << ", frame " << frame;
      three.scan(result.frame.bgr, area, pipeline.channel_gains(), runs);
      ASSERT_EQ(runs, expected) << target << " on three threads, frame " << frame;
    }
    use_simd_target({});
  }
}

TEST_P(FramePath, DetectsTheSameOnOneThreadOnThreeAndWhereThingsAreExpected) {
  testing::RecordingReporter reporter;
  BuiltPipeline full = build(GetParam(), {}, reporter);
  BuiltPipeline threads = build(GetParam(), {"scan.threads=3"}, reporter);
  BuiltPipeline predicted = build(GetParam(), {"scan.search=predicted"}, reporter);
  full.source.stage->open();
  FrameResult result;
  int led_by_predictions = 0;
  for (int frame = 0; frame < GetParam().frames; ++frame) {
    if (full.source.stage->read(result.frame) != ReadStatus::kFrame) break;
    full.pipeline->process(result);
    const std::string expected = text_of(result.detections);
    threads.pipeline->process(result);
    ASSERT_EQ(text_of(result.detections), expected) << "three threads, frame " << frame;
    predicted.pipeline->process(result);
    ASSERT_EQ(text_of(result.detections), expected) << "predicted, frame " << frame;
    led_by_predictions += &predicted.pipeline->scanned_area() != &predicted.pipeline->field_area();
  }
  if (GetParam().frames > 20) {
    EXPECT_GT(led_by_predictions, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, FramePath,
    ::testing::Values(Scene{"synthetic_3v3", "maggic_3v3", nullptr, 300},
                      Scene{"synthetic_5v5", "maggic_5v5", nullptr, 100},
                      Scene{"synthetic_legacy", "legacy_3v3", nullptr, 100},
                      Scene{"static", "maggic_3v3", "static.mp4", 100},
                      Scene{"all_tags", "maggic_3v3_three_tag", "all_tags.mp4"},
                      Scene{"tags_3v3_0", "maggic_3v3_three_tag", "tags_3v3_0.mp4"},
                      Scene{"tags_3v3_1", "maggic_3v3_three_tag", "tags_3v3_1.mp4"},
                      Scene{"rinobot_1", "maggic_3v3", "rinobot_1.jpg", 1},
                      Scene{"vsssdk", "diagonal_tags", "vsssdk_model_3908ae.jpg", 1}),
    name_of);

}  // namespace
}  // namespace maggic
