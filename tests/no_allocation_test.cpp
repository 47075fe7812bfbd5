/// No memory is asked for once a run is warm, from the source to the tracker.

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/videoio.hpp>

#include "maggic/runner.hpp"
#include "maggic/testing.hpp"
#include "pipeline/fake_stages_for_tests.hpp"
#include "temporary_folder.hpp"
#include "testing/allocation_counter.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using testing::AllocationCounter;

const fs::path kProject = MAGGIC_SOURCE_DIR;
constexpr std::uint64_t kWarmUpFrames = 60;
constexpr std::uint64_t kFrames = 100;

struct Case {
  const char* name;
  const char* pipeline;
  std::vector<std::string> assignments = {};
};

std::string name_of(const ::testing::TestParamInfo<Case>& test) { return test.param.name; }

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// What a run did during kFrames frames once kWarmUpFrames were through.
struct Observed {
  std::optional<std::uint64_t> asked_anywhere;
  std::optional<std::uint64_t> asked_on_the_frame_path;
  int led_by_predictions = 0;
  int scaled_for_light = 0;
};

Observed observe(BuiltPipeline& built, Reporter& reporter) {
  Observed observed;
  std::optional<AllocationCounter> counter;
  const std::atomic<bool> stop{false};
  const auto look = [&](const FrameResult&, const RunSummary& so_far) {
    if (so_far.processed == kWarmUpFrames) counter.emplace();
    const Pipeline& pipeline = *built.pipeline;
    observed.led_by_predictions += &pipeline.scanned_area() != &pipeline.field_area();
    observed.scaled_for_light += pipeline.channel_gains() != nullptr;
    if (so_far.processed != kWarmUpFrames + kFrames) return;
    observed.asked_anywhere = counter->count();
    observed.asked_on_the_frame_path = counter->count_of_this_thread();
  };
  const RunSummary summary =
      run(built, {.max_frames = kWarmUpFrames + kFrames + 1}, stop, reporter, look);
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  return observed;
}

BuiltPipeline build(const PipelineRequest& request, Reporter& reporter) {
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.sinks.clear();
  return built;
}

class NoAllocation : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!AllocationCounter::works()) GTEST_SKIP() << "the sanitizer has operator new for itself";
  }

  testing::RecordingReporter reporter_;
};

class NoAllocationIn : public NoAllocation, public ::testing::WithParamInterface<Case> {};

TEST_P(NoAllocationIn, TheWayFromTheSyntheticMatchToTheTracker) {
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (std::string(GetParam().pipeline) + ".yaml");
  request.assignments = GetParam().assignments;
  BuiltPipeline built = build(request, reporter_);
  const Observed observed = observe(built, reporter_);
  EXPECT_EQ(observed.asked_anywhere, 0u);
  EXPECT_EQ(observed.led_by_predictions > 0,
            built.pipeline->parts().scan.search == ScanParameters::Search::kPredicted);
  EXPECT_EQ(observed.scaled_for_light > 0, built.pipeline->parts().light.follow);
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines, NoAllocationIn,
    ::testing::Values(Case{"maggic_3v3", "maggic_3v3"}, Case{"maggic_5v5", "maggic_5v5"},
                      Case{"legacy_3v3", "legacy_3v3"}, Case{"three_tag", "maggic_3v3_three_tag"},
                      Case{"mixed_patterns", "mixed_patterns"},
                      Case{"two_threads", "maggic_3v3", {"scan.threads=2"}},
                      Case{"predicted", "maggic_3v3", {"scan.search=predicted"}},
                      Case{"following_the_light",
                           "maggic_3v3",
                           {"light.follow=true", "light.reference_rgb=[47, 44, 43]",
                            "source.synthetic_match.drift=[{time_s: 0, brightness: 0.9}, "
                            "{time_s: 5, brightness: 0.5, color_temperature_k: 4500}]"}},
                      Case{"subsampled_chroma",
                           "maggic_3v3",
                           {"source.synthetic_match.chroma_subsampling=true"}}),
    name_of);

/// The first `frames` frames of the match that `pipeline` is shipped with, as a recording.
void record(const fs::path& pipeline, std::uint64_t frames, const std::string& file) {
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = pipeline;
  BuiltPipeline built = build(request, reporter);
  Source& source = *built.source.stage;
  const double fps = source.open().frames_per_second;
  const int motion_jpeg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  Frame frame;
  ASSERT_EQ(source.read(frame), ReadStatus::kFrame);
  cv::VideoWriter writer(file, motion_jpeg, fps, frame.bgr.size());
  ASSERT_TRUE(writer.isOpened());
  for (std::uint64_t i = 0; i < frames; ++i) {
    writer.write(frame.bgr);
    ASSERT_EQ(source.read(frame), ReadStatus::kFrame);
  }
}

// What the decoder asks of the C library is its own affair and not counted.
TEST_F(NoAllocation, FromARecordingToTheTracker) {
  const testing::Folder folder;
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / "maggic_3v3.yaml";
  record(request.pipeline, kWarmUpFrames + kFrames + 1, folder.file("match.avi"));
  request.source =
      parse_document(fmt::format("video: {{path: '{}'}}", folder.file("match.avi")), "source");
  BuiltPipeline built = build(request, reporter_);
  EXPECT_EQ(observe(built, reporter_).asked_anywhere, 0u);
}

/// Stages that do not allocate, and what they are made to do with every frame.
struct Hooks {
  std::function<void(std::uint64_t)> source = [](std::uint64_t) {};
  std::function<void(std::uint64_t)> tracker = [](std::uint64_t) {};
  std::function<void(std::uint64_t)> sink = [](std::uint64_t) {};
};

Observed observe_fakes(bool image_stages, const Hooks& hooks) {
  constexpr std::uint64_t kAll = kWarmUpFrames + kFrames + 100;
  fakes::Rig rig(kAll, 2, image_stages);
  cv::Mat picture(48, 64, CV_8UC3, cv::Scalar::all(0));
  picture(cv::Rect(2, 1, 3, 2)).setTo(cv::Scalar(0, 0, 200));
  rig.source->picture = [picture](std::uint64_t) { return picture; };
  rig.source->before_read = hooks.source;
  rig.tracker->at_frame = hooks.tracker;
  for (fakes::RecordingSink* sink : rig.sinks) {
    sink->sequences.reserve(kAll);
    sink->at_write = hooks.sink;
  }
  return observe(rig.built, rig.reporter);
}

TEST_F(NoAllocation, FromAnySourceToTheSinksByTheHostItself) {
  for (const bool image_stages : {false, true}) {
    EXPECT_EQ(observe_fakes(image_stages, {}).asked_anywhere, 0u) << image_stages;
  }
}

TEST_F(NoAllocation, IsNotClaimedWhereAStageAllocates) {
  const auto allocate = [](std::uint64_t) {
    const auto memory = std::make_unique<cv::Mat>(3, 4, CV_8UC1);
    ASSERT_FALSE(memory->empty());
  };
  EXPECT_GE(observe_fakes(false, {.tracker = allocate}).asked_on_the_frame_path, kFrames);
  // Other threads are a few frames ahead or behind.
  EXPECT_GE(observe_fakes(false, {.source = allocate}).asked_anywhere, kFrames / 2);
  EXPECT_EQ(observe_fakes(false, {.source = allocate}).asked_on_the_frame_path, 0u);
  EXPECT_GE(observe_fakes(false, {.sink = allocate}).asked_anywhere, kFrames / 2);
}

}  // namespace
}  // namespace maggic
