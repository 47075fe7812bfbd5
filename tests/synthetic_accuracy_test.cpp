/// The shipped pipelines on 1,000 frames of the synthetic match at its default noise.

#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "maggic/runner.hpp"
#include "maggic/scorecard.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

const std::filesystem::path kProject = MAGGIC_SOURCE_DIR;

// Sanitizer builds run 20 times slower; they look for memory errors, not for accuracy.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kFrames = 100;
#else
constexpr int kFrames = 1000;
#endif

class SyntheticMatch : public ::testing::TestWithParam<std::string> {};

TEST_P(SyntheticMatch, IsFoundToTheMillimetre) {
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (GetParam() + ".yaml");
  testing::RecordingReporter reporter;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.sinks.clear();
  Scorecard score;
  const std::atomic<bool> stop{false};
  const RunSummary summary =
      run(built, {.max_frames = kFrames}, stop, reporter,
          [&](const FrameResult& result, const RunSummary&) {
            ASSERT_TRUE(result.frame.has_truth);
            score.add(result.detections, scene_of(result.frame.truth), *built.pipeline->field());
          });
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  ASSERT_EQ(score.frames(), static_cast<std::uint64_t>(kFrames));
  const ObjectTally robots = score.robots();
  const ObjectTally& ball = score.ball();
  EXPECT_GE(static_cast<double>(robots.right_identity), 0.999 * static_cast<double>(robots.frames));
  EXPECT_EQ(score.false_robots(), 0u);
  EXPECT_LE(robots.position_mm.rmse(), 1.5);
  EXPECT_LE(robots.heading_deg.rmse(), 1.5);
  EXPECT_GE(static_cast<double>(ball.seen), 0.999 * static_cast<double>(ball.frames));
  EXPECT_EQ(score.false_balls(), 0u);
  EXPECT_LE(ball.position_mm.rmse(), 2.0);
  RecordProperty("position_rmse_mm", std::to_string(robots.position_mm.rmse()));
  RecordProperty("heading_rmse_deg", std::to_string(robots.heading_deg.rmse()));
  RecordProperty("ball_rmse_mm", std::to_string(ball.position_mm.rmse()));
}

INSTANTIATE_TEST_SUITE_P(Pipelines, SyntheticMatch,
                         ::testing::Values("maggic_3v3", "maggic_5v5", "maggic_3v3_three_tag",
                                           "legacy_3v3", "mixed_patterns"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace maggic
