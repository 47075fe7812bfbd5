#include "maggic/speed_measurement.hpp"

#include <gmock/gmock.h>

#include "maggic/machine_description.hpp"
#include "measurement/cache_eviction.hpp"
#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::HasSubstr;

constexpr std::uint64_t kFrames = 3;

void expect_measured(const DurationFigures& figures) {
  EXPECT_GT(figures.min, nanoseconds(0));
  EXPECT_LE(figures.min, figures.p50);
  EXPECT_LE(figures.p50, figures.p99);
}

/// Frames of 64 × 48 with one red square of 10 × 10 each.
class SpeedMeasurement : public ::testing::Test {
 protected:
  SpeedMeasurement() { prepare(rig_); }

  static void prepare(fakes::Rig& rig) {
    rig.source->count = 4;
    rig.source->picture = [](std::uint64_t) {
      cv::Mat picture(48, 64, CV_8UC3, cv::Scalar::all(0));
      picture(cv::Rect(20, 20, 10, 10)).setTo(cv::Scalar(0, 0, 255));
      return picture;
    };
  }

  static FrameStore store_of(fakes::Rig& rig) {
    return {rig.built.source, {.frames = 4}, rig.reporter};
  }

  fakes::Rig rig_{4};
};

TEST_F(SpeedMeasurement, TakesTheTimeOfEveryStepOfTheFramePath) {
  const FrameStore store = store_of(rig_);
  int tracked = 0;
  rig_.tracker->at_frame = [&](std::uint64_t) {
    ++tracked;
    std::this_thread::sleep_for(milliseconds(1));
  };
  const FramePathSpeed speed = measure_frame_path(*rig_.built.pipeline, store, kFrames);
  EXPECT_GT(tracked, static_cast<int>(kFrames)) << "some warm up";
  for (const DurationFigures& figures : {speed.floor, speed.segment, speed.blobs, speed.track,
                                         speed.pixels_to_blobs, speed.pixels_to_detections}) {
    expect_measured(figures);
  }
  ASSERT_TRUE(speed.plain_table);
  expect_measured(*speed.plain_table);
  EXPECT_GE(speed.track.min, milliseconds(1));
  EXPECT_GE(speed.pixels_to_detections.min, milliseconds(1));
  EXPECT_GE(speed.pixels_to_detections.min, speed.track.min);
  EXPECT_EQ(speed.runs_a_frame, 10.0);
  EXPECT_EQ(speed.blobs_a_frame, 1.0);
  EXPECT_EQ(speed.robots_a_frame, 0.0);
}

TEST_F(SpeedMeasurement, WithoutAColorTableLeavesOutWhatNeedsOne) {
  fakes::Rig image_rig(4, 0, true);
  prepare(image_rig);
  const FrameStore store = store_of(image_rig);
  const FramePathSpeed speed = measure_frame_path(*image_rig.built.pipeline, store, kFrames);
  EXPECT_FALSE(speed.plain_table);
  expect_measured(speed.floor);
  expect_measured(speed.pixels_to_blobs);
  EXPECT_FALSE(measure_table(*image_rig.built.pipeline, nullptr, 1, 1));
}

TEST_F(SpeedMeasurement, CompilesTheTableAgainWithTheChangedSegmenter) {
  struct Counting final : ColorSegmenter {
    void segment(const ColorBatch&, const ColorBatch&, std::span<Label> labels) const override {
      colors += labels.size();
      std::ranges::fill(labels, kBackground);
    }
    mutable std::atomic<std::size_t> colors{0};
  } changed;
  const auto speed = measure_table(*rig_.built.pipeline, &changed, 2, 2);
  ASSERT_TRUE(speed);
  EXPECT_EQ(changed.colors, 2 * ColorTable::kColors);
  for (const DurationFigures& figures :
       {speed->compile, speed->compile_in_threads, speed->update, speed->memcpy_16mib}) {
    expect_measured(figures);
  }
}

TEST_F(SpeedMeasurement, CountsTheFramesOfAllPipelinesAtOnce) {
  fakes::Rig other(4);
  const FrameStore store = store_of(rig_);
  std::atomic<int> tracked{0};
  for (fakes::Rig* rig : {&rig_, &other}) {
    rig->tracker->at_frame = [&](std::uint64_t) {
      ++tracked;
      std::this_thread::sleep_for(milliseconds(2));
    };
  }
  Pipeline* const pipelines[] = {rig_.built.pipeline.get(), other.built.pipeline.get()};
  const double rate = measure_throughput(pipelines, store, kFrames);
  EXPECT_GT(rate, 0.0);
  EXPECT_LT(rate, 2 * 500.0) << "no pipeline can take more than 500 a second";
  EXPECT_GT(tracked, 5 * 2 * static_cast<int>(kFrames)) << "five rounds and a warm-up";
}

TEST_F(SpeedMeasurement, AFailingFrameEndsTheThroughput) {
  const FrameStore store = store_of(rig_);
  rig_.tracker->at_frame = [](std::uint64_t) { throw std::runtime_error("no"); };
  Pipeline* const pipelines[] = {rig_.built.pipeline.get()};
  EXPECT_THROW(measure_throughput(pipelines, store, kFrames), StageError);
}

TEST_F(SpeedMeasurement, LatencyHoldsTheWholeWayThroughTheRunLoop) {
  const FrameStore store = store_of(rig_);
  rig_.tracker->at_frame = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(2)); };
  int written = 0;
  rig_.sinks.front()->at_write = [&](std::uint64_t) { ++written; };
  const LatencySpeed speed = measure_latency(rig_.built, store, kFrames, rig_.reporter);
  EXPECT_GE(speed.capture_to_detection.min, milliseconds(2));
  expect_measured(speed.capture_to_detection);
  EXPECT_EQ(speed.frames, kFrames);
  EXPECT_DOUBLE_EQ(speed.frames_per_second, 100.0) << "the source's own";
  EXPECT_EQ(written, 0) << "measuring writes no log";
}

TEST_F(SpeedMeasurement, AFailingFrameEndsTheLatency) {
  const FrameStore store = store_of(rig_);
  rig_.tracker->at_frame = [](std::uint64_t) { throw std::runtime_error("not today"); };
  try {
    measure_latency(rig_.built, store, kFrames, rig_.reporter);
    FAIL() << "the tracker failed, no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("tracker 'hook' failed at frame"));
  }
}

TEST(CacheEviction, ReadsMoreThanTheCachesHold) {
  CacheEvictor caches;
  caches.evict();
  EXPECT_GE(caches.bytes(), std::size_t{64} << 20);
  EXPECT_GE(caches.bytes(), 2 * describe_machine().last_level_cache_bytes);
}

TEST(MachineDescription, NamesTheProcessor) {
  const MachineDescription machine = describe_machine();
  EXPECT_FALSE(machine.cpu.empty());
  EXPECT_GE(machine.cores, 1U);
}

}  // namespace
}  // namespace maggic
