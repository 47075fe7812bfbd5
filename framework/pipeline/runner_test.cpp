#include "maggic/runner.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using fakes::Rig;
using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

RunSummary run_to_end(Rig& rig, const RunOptions& options = {}) {
  const std::atomic<bool> stop{false};
  return run(rig.built, options, stop, rig.reporter);
}

std::vector<std::uint64_t> first(std::uint64_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(RunRecorded, EveryFrameReachesEverySinkInOrder) {
  Rig rig(100, 3);
  const RunSummary summary = run_to_end(rig);
  EXPECT_TRUE(summary.clean());
  EXPECT_EQ(summary.processed, 100u);
  EXPECT_EQ(summary.dropped, 0u);
  for (const fakes::RecordingSink* sink : rig.sinks) {
    EXPECT_EQ(sink->sequences, first(100));
    EXPECT_TRUE(sink->closed);
  }
}

TEST(RunRecorded, ASlowSinkSlowsTheRunButLosesNothing) {
  Rig rig(20, 2);
  rig.sinks[0]->at_write = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(2)); };
  const RunSummary summary = run_to_end(rig, {.sink_queue_frames = 2});
  EXPECT_EQ(rig.sinks[0]->sequences, first(20));
  EXPECT_EQ(rig.sinks[1]->sequences, first(20));
  EXPECT_EQ(summary.sinks[0].dropped, 0u);
}

TEST(RunRecorded, StopsAfterMaxFrames) {
  Rig rig(100);
  EXPECT_EQ(run_to_end(rig, {.max_frames = 7}).processed, 7u);
  EXPECT_EQ(rig.sinks[0]->sequences, first(7));
}

TEST(RunRecorded, FramesThatAreSkippedOrFailCountForMaxFrames) {
  Rig rig(1'000'000);
  rig.source->picture = [](std::uint64_t n) {
    return n % 2 == 0 ? cv::Mat() : cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(0));
  };
  rig.tracker->at_frame = [](std::uint64_t) { throw std::runtime_error("no"); };
  const RunSummary summary = run_to_end(rig, {.max_frames = 7});
  EXPECT_EQ(summary.skipped, 4u);
  EXPECT_EQ(summary.failed, 3u);
  EXPECT_EQ(summary.taken(), 7u);
}

TEST(RunRecorded, StopsAfterTheWantedTimeOfTheSource) {
  Rig rig(1'000'000);
  EXPECT_EQ(run_to_end(rig, {.max_duration_s = 0.5}).processed, 50u) << "10 ms apart";
}

TEST(RunRecorded, FramesThatAreSkippedOrFailTakeTheirTimeToo) {
  Rig skipping(1'000'000);
  skipping.source->picture = [](std::uint64_t) { return cv::Mat(); };
  EXPECT_EQ(run_to_end(skipping, {.max_duration_s = 0.5}).skipped, 50u);
  Rig failing(1'000'000);
  failing.tracker->at_frame = [](std::uint64_t) { throw std::runtime_error("no"); };
  EXPECT_EQ(run_to_end(failing, {.max_duration_s = 0.5}).failed, 50u);
}

TEST(RunRecorded, ARecordingThatLoopsReachesTheWantedTime) {
  Rig rig(1'000'000);
  rig.source->captured = [](std::uint64_t n) { return milliseconds(10 * (n % 11)); };
  EXPECT_EQ(run_to_end(rig, {.max_duration_s = 0.5}).processed, 54u)
      << "49 steps of 10 ms and 4 jumps back";
}

TEST(RunRecorded, AFrameNeverKeepsTheTrueLabelsOfAnotherOne) {
  Rig rig(60);
  rig.source->labelled = 30;
  const std::atomic<bool> stop{false};
  std::vector<std::uint64_t> labelled;
  run(rig.built, {}, stop, rig.reporter, [&](const FrameResult& result, const RunSummary&) {
    if (!result.frame.truth_labels.empty()) labelled.push_back(result.frame.sequence);
  });
  EXPECT_EQ(labelled, first(30));
}

/// Where the two threads of a run wait for each other.
class Meeting {
 public:
  /// Whether the other one comes to meeting `number` too. Nobody waits after one that failed.
  bool of_source(int number) { return meet(source_, tracker_, number); }
  bool of_tracker(int number) { return meet(tracker_, source_, number); }

 private:
  bool meet(int& self, const int& other, int number) {
    std::unique_lock lock(mutex_);
    self = number;
    changed_.notify_all();
    changed_.wait_for(lock, std::chrono::seconds(10), [&] { return failed_ || other >= number; });
    failed_ = failed_ || other < number;
    return !failed_;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  int source_ = 0;
  int tracker_ = 0;
  bool failed_ = false;
};

// The source reads frame n + 1 only while the tracker is at frame n, which in turn waits for that.
TEST(RunRecorded, ReadsAFrameWhileTheOneBeforeItIsTracked) {
  Rig rig(50, 0);
  Meeting meeting;
  std::atomic<int> read_meanwhile{0};
  std::atomic<int> tracked_meanwhile{0};
  rig.source->before_read = [&](std::uint64_t n) {
    if (n == 0) return;
    if (!meeting.of_source(static_cast<int>(n))) throw std::runtime_error("read alone");
    ++read_meanwhile;
  };
  rig.tracker->at_frame = [&](std::uint64_t n) {
    if (n + 1 == rig.source->count) return;
    if (!meeting.of_tracker(static_cast<int>(n) + 1)) throw std::runtime_error("tracked alone");
    ++tracked_meanwhile;
  };
  const RunSummary summary = run_to_end(rig, {.max_frames = 50});
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  EXPECT_EQ(read_meanwhile, 49);
  EXPECT_EQ(tracked_meanwhile, 49);
}

TEST(RunRecorded, StagesAndSinksAreGivenThePictureItselfNotACopy) {
  Rig rig(40, 1, true);
  std::vector<const unsigned char*> made;
  std::vector<const unsigned char*> segmented;
  std::vector<const unsigned char*> done;
  std::vector<const unsigned char*> written;
  rig.source->picture = [&](std::uint64_t) {
    const cv::Mat picture(8, 8, CV_8UC3, cv::Scalar::all(0));
    made.push_back(picture.data);
    return picture;
  };
  rig.segmenter->at_picture = [&](const cv::Mat& bgr) { segmented.push_back(bgr.data); };
  rig.sinks[0]->at_picture = [&](const cv::Mat& bgr) { written.push_back(bgr.data); };
  const std::atomic<bool> stop{false};
  run(rig.built, {}, stop, rig.reporter,
      [&](const FrameResult& result, const RunSummary&) { done.push_back(result.frame.bgr.data); });
  ASSERT_THAT(made, SizeIs(40));
  EXPECT_EQ(segmented, made);
  EXPECT_EQ(done, made);
  EXPECT_EQ(written, made);
}

TEST(RunRecorded, ThePipelineMayBeExchangedBetweenTwoFrames) {
  Rig rig(10);
  Rig other(0);
  std::vector<std::uint64_t> tracked;
  rig.tracker->at_frame = [&](std::uint64_t sequence) { tracked.push_back(sequence); };
  std::vector<std::uint64_t> tracked_by_other;
  other.tracker->at_frame = [&](std::uint64_t n) { tracked_by_other.push_back(n); };
  const std::atomic<bool> stop{false};
  const auto exchange_after_3 = [&](const FrameResult& result, const RunSummary&) {
    if (result.frame.sequence == 3) rig.built.pipeline.swap(other.built.pipeline);
  };
  EXPECT_TRUE(run(rig.built, {}, stop, rig.reporter, exchange_after_3).clean());
  EXPECT_EQ(rig.sinks[0]->sequences, first(10));
  EXPECT_THAT(tracked, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(tracked_by_other, ElementsAre(4, 5, 6, 7, 8, 9));
}

TEST(RunRecorded, APipelineThatContinuesFromAnotherKeepsItsTracker) {
  Rig rig(6);
  Rig next(0);
  std::vector<std::uint64_t> tracked;
  rig.tracker->at_frame = [&](std::uint64_t sequence) { tracked.push_back(sequence); };
  const std::atomic<bool> stop{false};
  const auto exchange_after_3 = [&](const FrameResult& result, const RunSummary&) {
    if (result.frame.sequence != 3) return;
    next.built.pipeline->continue_from(*rig.built.pipeline);
    rig.built.pipeline.swap(next.built.pipeline);
    next.built.pipeline.reset();
  };
  EXPECT_TRUE(run(rig.built, {}, stop, rig.reporter, exchange_after_3).clean());
  EXPECT_EQ(tracked, first(6));
}

TEST(RunLive, NewestFrameWinsAndDropsAreCounted) {
  Rig rig(50);
  rig.source->live = true;
  rig.source->before_read = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(1)); };
  rig.tracker->at_frame = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(5)); };
  const RunSummary summary = run_to_end(rig);
  EXPECT_GT(summary.dropped, 0u);
  EXPECT_EQ(summary.processed + summary.dropped, 50u);
  EXPECT_TRUE(std::ranges::is_sorted(rig.sinks[0]->sequences));
  EXPECT_EQ(rig.sinks[0]->sequences.back(), 49u) << "the newest frame is never the one dropped";
}

TEST(RunLive, ASlowSinkNeverDelaysTheFramePath) {
  Rig rig(60, 2);
  rig.source->live = true;
  rig.source->before_read = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(1)); };
  rig.sinks[0]->at_write = [](std::uint64_t) { std::this_thread::sleep_for(milliseconds(20)); };
  const RunSummary summary = run_to_end(rig, {.sink_queue_frames = 2});
  EXPECT_GT(summary.sinks[0].dropped, 0u);
  EXPECT_EQ(summary.sinks[0].written + summary.sinks[0].dropped, summary.processed);
  EXPECT_GT(summary.sinks[1].written, summary.sinks[0].written);
}

TEST(RunRealtime, PlaysARecordingAtItsOwnPace) {
  Rig rig(11);  // 10 ms apart
  const auto start = std::chrono::steady_clock::now();
  run_to_end(rig, {.realtime = true});
  EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(99));
}

TEST(RunRealtime, AJumpBackStartsTheClockAnew) {
  Rig rig(10);
  rig.source->captured = [](std::uint64_t n) { return milliseconds(n < 5 ? 10 * n : 10 * n - 40); };
  const auto start = std::chrono::steady_clock::now();
  run_to_end(rig, {.realtime = true});
  EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(79)) << "40 ms, twice";
}

TEST(RunTrouble, AThrowingTrackerIsNamedWithItsFrameAndTheRunGoesOn) {
  Rig rig(5);
  rig.tracker->at_frame = [](std::uint64_t n) {
    if (n == 2) throw std::runtime_error("lost my marbles");
  };
  const RunSummary summary = run_to_end(rig);
  EXPECT_EQ(summary.failed, 1u);
  EXPECT_EQ(summary.first_error, "tracker 'hook' failed at frame 2: lost my marbles");
  EXPECT_THAT(rig.sinks[0]->sequences, ElementsAre(0, 1, 3, 4));
  EXPECT_FALSE(summary.clean());
}

TEST(RunTrouble, WhatIsNoStdExceptionIsReportedToo) {
  Rig rig(2);
  rig.tracker->at_frame = [](std::uint64_t) { throw 42; };
  EXPECT_THAT(run_to_end(rig).first_error, HasSubstr("not a std::exception"));
}

TEST(RunTrouble, WhatFailsBetweenTheStagesIsCountedAndTheRunGoesOn) {
  FieldParameters under_the_tags;
  under_the_tags.camera_height_mm = 10.0;
  Rig rig(3, 1, false, under_the_tags);
  const RunSummary summary = run_to_end(rig);
  EXPECT_EQ(summary.failed, 3u);
  EXPECT_THAT(summary.first_error, HasSubstr("frame 0 failed: an object 75 mm high"));
  EXPECT_THAT(rig.reporter.messages(), SizeIs(3));
  EXPECT_TRUE(rig.sinks[0]->closed);
}

TEST(RunTrouble, AReporterThatThrowsEndsNothing) {
  struct Broken : Reporter {
    void warn(std::string_view) override { throw std::bad_alloc(); }
  };
  Rig rig(6, 2);
  rig.tracker->at_frame = [](std::uint64_t n) {
    if (n == 2) throw std::runtime_error("no");
  };
  rig.sinks[0]->at_open = [] { throw std::runtime_error("no"); };
  rig.source->before_read = [](std::uint64_t n) {
    if (n == 5) throw std::runtime_error("no");
  };
  Broken reporter;
  const std::atomic<bool> stop{false};
  const RunSummary summary = run(rig.built, {}, stop, reporter);
  EXPECT_EQ(summary.failed, 1u);
  EXPECT_TRUE(summary.source_failed);
  EXPECT_THAT(rig.sinks[1]->sequences, ElementsAre(0, 1, 3, 4));
}

TEST(RunTrouble, ASinkThatCannotOpenLeavesTheOthersAlone) {
  Rig rig(10, 2);
  rig.sinks[0]->at_open = [] { throw std::runtime_error("no such folder"); };
  const RunSummary summary = run_to_end(rig);
  EXPECT_EQ(summary.processed, 10u);
  EXPECT_EQ(summary.sinks[0].first_error, "sink 'recording' failed to open: no such folder");
  EXPECT_THAT(rig.sinks[0]->sequences, IsEmpty());
  EXPECT_EQ(rig.sinks[1]->sequences, first(10));
  EXPECT_FALSE(summary.clean());
}

TEST(RunTrouble, ASinkThatFailsToWriteIsCountedAndTriedAgain) {
  Rig rig(4);
  rig.sinks[0]->at_write = [](std::uint64_t n) {
    if (n < 2) throw std::runtime_error("disk full");
  };
  const RunSummary summary = run_to_end(rig);
  EXPECT_EQ(summary.sinks[0].failed, 2u);
  EXPECT_EQ(summary.sinks[0].written, 2u);
  EXPECT_EQ(summary.sinks[0].first_error, "sink 'recording' failed at frame 0: disk full");
  EXPECT_TRUE(rig.sinks[0]->closed);
}

TEST(RunTrouble, ASourceThatFailsHalfwayKeepsWhatWasSeen) {
  Rig rig(10);
  rig.source->before_read = [](std::uint64_t n) {
    if (n == 5) throw std::runtime_error("bad sector");
  };
  const RunSummary summary = run_to_end(rig);
  EXPECT_TRUE(summary.source_failed);
  EXPECT_EQ(summary.first_error, "source 'counting' failed at frame 5: bad sector");
  EXPECT_EQ(rig.sinks[0]->sequences, first(5));
}

TEST(RunTrouble, UnusableFramesAreSkippedAndCounted) {
  Rig rig(4);
  rig.source->picture = [](std::uint64_t n) {
    return n == 1 ? cv::Mat() : cv::Mat(5, 7, CV_8UC3, cv::Scalar::all(0));
  };
  const RunSummary summary = run_to_end(rig);
  EXPECT_EQ(summary.skipped, 1u);
  EXPECT_EQ(summary.processed, 3u);
  EXPECT_THAT(rig.reporter.messages(), Contains(HasSubstr("skipped")));
}

TEST(RunTrouble, StoppingClosesTheSinks) {
  Rig rig(1'000'000);
  std::atomic<bool> stop{false};
  const RunSummary summary =
      run(rig.built, {}, stop, rig.reporter, [&](const FrameResult& result, const RunSummary&) {
        if (result.frame.sequence == 20) stop = true;
      });
  EXPECT_EQ(summary.processed, 21u);
  EXPECT_TRUE(rig.sinks[0]->closed);
  EXPECT_EQ(rig.sinks[0]->sequences, first(21));
}

TEST(RunTrouble, AHangingSinkDoesNotKeepAStoppedRunWaiting) {
  Rig rig(1'000'000, 2);
  std::atomic<bool> hanging{true};
  rig.sinks[0]->at_write = [&](std::uint64_t) {
    while (hanging) std::this_thread::sleep_for(milliseconds(1));
  };
  std::atomic<bool> stop{false};
  // Frame 0 hangs, frame 1 waits in the queue, frame 2 finds no room.
  rig.tracker->at_frame = [&](std::uint64_t n) { stop = n == 2; };
  const RunSummary summary =
      run(rig.built, {.sink_queue_frames = 1, .patience_after_stop = milliseconds(10)}, stop,
          rig.reporter, [&](const FrameResult& result, const RunSummary&) {
            if (result.frame.sequence == 2) hanging = false;
          });
  EXPECT_EQ(summary.sinks[0].dropped, 1u);
  EXPECT_THAT(rig.sinks[0]->sequences, ElementsAre(0, 1));
  EXPECT_EQ(rig.sinks[1]->sequences, first(3));
  EXPECT_TRUE(rig.sinks[0]->closed);
}

}  // namespace
}  // namespace maggic
