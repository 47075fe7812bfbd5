/// Robots and ball in a picture that is otherwise nothing but noise.

#include <filesystem>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "maggic/pipeline_builder.hpp"
#include "maggic/scorecard.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::filesystem::path kProject = MAGGIC_SOURCE_DIR;

/// Every pixel further than this from a robot's or the ball's centre becomes a random colour.
constexpr double kRobotClearance_mm = 75.0;
constexpr double kBallClearance_mm = 40.0;

void bury_in_noise(Frame& frame, const Field& field, cv::RNG& random) {
  cv::Mat noise(frame.bgr.size(), CV_8UC3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::Mat1b noisy(frame.bgr.size(), 255);
  const auto clear = [&](cv::Point2d centroid_px, double radius_mm) {
    const double mm_per_px = std::sqrt(field.mm2_per_px2(centroid_px, 0.0));
    cv::circle(noisy, centroid_px, static_cast<int>(radius_mm / mm_per_px), 0, cv::FILLED);
  };
  for (const RobotDetection& robot : frame.truth.robots) {
    clear(robot.centroid_px, kRobotClearance_mm);
  }
  clear(frame.truth.ball->centroid_px, kBallClearance_mm);
  noise.copyTo(frame.bgr, noisy);
}

TEST(Noise, BeyondTheCapHidesNeitherRobotsNorBall) {
  constexpr std::size_t kFrames = 20;
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / "maggic_3v3.yaml";
  testing::RecordingReporter reporter;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.source.stage->open();
  cv::RNG random(5);
  Scorecard score;
  FrameResult result;
  for (std::size_t i = 0; i < kFrames; ++i) {
    ASSERT_EQ(built.source.stage->read(result.frame), ReadStatus::kFrame);
    const Field field(built.pipeline->parts().field, result.frame.bgr.size());
    bury_in_noise(result.frame, field, random);
    ASSERT_EQ(built.pipeline->process(result), FrameOutcome::kProcessed);
    ASSERT_GT(result.runs.size(), built.pipeline->blob_limits_px().max_runs);
    score.add(result.detections, scene_of(result.frame.truth), field);
  }
  EXPECT_EQ(score.robots().right_identity, 6 * kFrames);
  EXPECT_LE(score.robots().position_mm.rmse(), 1.5);
  EXPECT_EQ(score.ball().seen, kFrames);
  EXPECT_THAT(reporter.messages(), SizeIs(kFrames));
  EXPECT_THAT(reporter.messages(), Each(HasSubstr("more runs than blobs.max_runs: those shorter")));
}

}  // namespace
}  // namespace maggic
