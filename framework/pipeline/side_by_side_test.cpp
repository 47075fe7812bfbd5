#include "maggic/side_by_side.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using fakes::Rig;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two pipelines of fakes; frames come from the first one's source.
class SideBySideTest : public ::testing::Test {
 protected:
  std::vector<RunSummary> run(std::optional<std::uint64_t> max_frames = std::nullopt,
                              const OnFrames& on_frames = {}) {
    Pipeline* const pipelines[] = {first_.built.pipeline.get(), second_.built.pipeline.get()};
    return run_side_by_side(first_.built.source, pipelines, max_frames, stop_, first_.reporter,
                            on_frames);
  }

  Rig first_{6, 0, true};
  Rig second_{0, 0, true};
  std::atomic<bool> stop_{false};
};

TEST_F(SideBySideTest, GivesEveryPipelineTheSamePicturesReadOnce) {
  first_.source->picture = [](std::uint64_t i) {
    return cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, static_cast<double>(i)));
  };
  std::vector<int> reds;
  const auto summaries = run(
      std::nullopt, [&](std::span<const FrameResult* const> results, std::span<const RunSummary>) {
        ASSERT_EQ(results.size(), 2u);
        EXPECT_EQ(results[0]->frame.bgr.data, results[1]->frame.bgr.data);
        EXPECT_EQ(results[0]->frame.sequence, results[1]->frame.sequence);
        reds.push_back(results[1]->frame.bgr.at<cv::Vec3b>(0, 0)[2]);
      });
  EXPECT_THAT(reds, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(first_.source->given, 6u);
  for (const RunSummary& summary : summaries) {
    EXPECT_EQ(summary.processed, 6u);
    EXPECT_TRUE(summary.clean());
    EXPECT_EQ(summary.times.frame_path().count(), 6u);
  }
}

TEST_F(SideBySideTest, PipelinesTakeTurnsInBeingTheFirst) {
  std::vector<char> order;
  first_.tracker->at_frame = [&](std::uint64_t) { order.push_back('a'); };
  second_.tracker->at_frame = [&](std::uint64_t) { order.push_back('b'); };
  run(3);
  EXPECT_THAT(order, ElementsAre('a', 'b', 'b', 'a', 'a', 'b'));
}

TEST_F(SideBySideTest, APipelineThatFailsLeavesTheOthersAlone) {
  second_.tracker->at_frame = [](std::uint64_t sequence) {
    if (sequence == 1) throw std::runtime_error("lost");
  };
  std::vector<bool> has_second;
  const auto summaries =
      run(3, [&](std::span<const FrameResult* const> results, std::span<const RunSummary>) {
        EXPECT_NE(results[0], nullptr);
        has_second.push_back(results[1] != nullptr);
      });
  EXPECT_THAT(has_second, ElementsAre(true, false, true));
  EXPECT_TRUE(summaries[0].clean());
  EXPECT_EQ(summaries[1].failed, 1u);
  EXPECT_THAT(summaries[1].first_error, HasSubstr("tracker 'hook' failed at frame 1: lost"));
}

TEST_F(SideBySideTest, WhatIsNoPictureIsSkippedForAll) {
  first_.source->picture = [](std::uint64_t i) {
    return i == 0 ? cv::Mat() : cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(0));
  };
  int calls = 0;
  const auto summaries = run(std::nullopt, [&](auto, auto) { ++calls; });
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(summaries[1].skipped, 1u);
  EXPECT_EQ(summaries[1].processed, 5u);
}

TEST_F(SideBySideTest, ASourceThatFailsIsToldOfEveryPipeline) {
  first_.source->before_read = [](std::uint64_t i) {
    if (i == 2) throw std::runtime_error("unplugged");
  };
  const auto summaries = run();
  EXPECT_EQ(summaries[0].processed, 2u);
  for (const RunSummary& summary : summaries) {
    EXPECT_TRUE(summary.source_failed);
    EXPECT_THAT(summary.first_error, HasSubstr("unplugged"));
  }
}

TEST_F(SideBySideTest, EndsWhenAskedToStop) {
  const auto summaries = run(std::nullopt, [&](auto, auto) { stop_ = true; });
  EXPECT_EQ(summaries[0].processed, 1u);
}

TEST_F(SideBySideTest, WhatTheCallerThrowsEndsTheRun) {
  EXPECT_THROW(run(std::nullopt, [](auto, auto) { throw std::invalid_argument("wrong size"); }),
               std::invalid_argument);
}

}  // namespace
}  // namespace maggic
