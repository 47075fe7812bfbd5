#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/live_line.hpp"
#include "app/summary.hpp"
#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

LiveState half_done() {
  LiveState state;
  state.processed = 500;
  state.total = 1000;
  state.elapsed_s = 75.0;
  state.frames_per_second = 6.66;
  state.robots = 6;
  state.ball = true;
  state.frame_path = {0.5, 0.75};
  return state;
}

TEST(LiveLine, ShowsBarAndTimeLeftOfAFiniteSource) {
  EXPECT_THAT(live_line(half_done(), 200),
              AllOf(HasSubstr("[##########----------]  50% ETA 1:15"), HasSubstr("7 fps"),
                    HasSubstr("6 robots+ball"), HasSubstr("0 dropped"),
                    HasSubstr("p50/p99 0.50/0.75 ms"), HasSubstr("track 0.00/0.00")));
}

TEST(LiveLine, CountsFramesOfAnEndlessSource) {
  LiveState state = half_done();
  state.total.reset();
  state.ball = false;
  EXPECT_THAT(live_line(state, 200),
              AllOf(HasSubstr("frame 500"), HasSubstr("no ball"), Not(HasSubstr("ETA"))));
}

TEST(LiveLine, MeasuresProgressByEveryFrameTheSourceGave) {
  LiveState state = half_done();
  state.processed = 100;
  state.dropped = 400;
  state.skipped = 200;
  state.failed = 50;
  EXPECT_THAT(live_line(state, 200), HasSubstr(" 75% ETA 0:25"));
}

TEST(LiveLine, MeasuresProgressTowardsAFrameLimitByFramesTaken) {
  LiveState state = half_done();
  state.total.reset();
  state.max_taken = 1000;
  state.processed = 100;
  state.dropped = 400;
  state.skipped = 100;
  state.failed = 50;
  EXPECT_THAT(live_line(state, 200), HasSubstr(" 25% ETA 3:45"));
  state.total = 2000;
  EXPECT_THAT(live_line(state, 200), HasSubstr(" 32%")) << "the source ends before the limit";
}

TEST(LiveLine, FitsTheFramePathsTimesIntoAnOrdinaryTerminal) {
  EXPECT_EQ(live_line(half_done(), 79),
            "[###---]  50% ETA 1:15  7 fps  6 robots+ball  0 dropped  p50/p99 0.50/0.75 ms");
}

TEST(LiveLine, NeverGetsWiderThanAsked) {
  LiveState state = half_done();
  state.failed = 12;
  state.skipped = 3;
  for (int width = 1; width < 250; ++width) {
    EXPECT_LE(live_line(state, width).size(), static_cast<std::size_t>(width));
  }
}

TEST(LiveLine, SurvivesOddNumbers) {
  LiveState state;
  state.processed = 20;
  state.total = 0;
  EXPECT_THAT(live_line(state, 80), HasSubstr("frame 20"));
  state.total = 10;
  EXPECT_THAT(live_line(state, 80), HasSubstr("100%"));
}

TEST(LiveLine, SaysThatItWaitsUntilTheFirstFrame) {
  LiveState state;
  state.elapsed_s = 12.9;
  state.total = 100;
  EXPECT_EQ(live_line(state, 80), "waiting for the first frame (12 s); Ctrl-C ends");
  EXPECT_EQ(live_line(state, 7), "waiting");
  state.skipped = 1;
  EXPECT_THAT(live_line(state, 80), Not(HasSubstr("waiting")));
}

TEST(TextTable, AlignsColumnsByWhatIsSeen) {
  TextTable table({TextTable::Align::kLeft, TextTable::Align::kRight, TextTable::Align::kLeft});
  table.add({"a", "1", "first"});
  table.add({"0 … 2", "100", "second"});
  EXPECT_EQ(table.to_string(1, 80),
            " a        1  first\n"
            " 0 … 2  100  second\n");
}

TEST(TextTable, WrapsItsLastColumn) {
  TextTable table({TextTable::Align::kLeft, TextTable::Align::kLeft});
  table.add({"key", "a rather long meaning that wraps"});
  EXPECT_EQ(table.to_string(0, 29),
            "key  a rather long meaning\n"
            "     that wraps\n");
}

TEST(Summary, NamesFailedOutputsAndTheirReason) {
  RunSummary summary;
  summary.processed = 20;
  summary.sinks.push_back({"jsonl", 15, 0, 5, "cannot write 'x': No space left on device"});
  EXPECT_THAT(summary_text(summary, Found(), Scorecard(), 2.0),
              AllOf(HasSubstr("20 frames in 2.0 s (10.0 fps)"),
                    HasSubstr("jsonl  15  frames, 5 failed: cannot write 'x': No space left"),
                    Not(HasSubstr("ground truth"))));
}

TEST(Summary, TellsWhatWasSeen) {
  RunSummary summary;
  summary.processed = 2;
  Detections detections;
  detections.robots.resize(6);
  detections.ball.emplace();
  Found found;
  found.add(detections);
  detections.robots.front().state = TrackState::kPredicted;
  detections.ball->state = TrackState::kPredicted;
  found.add(detections);
  EXPECT_THAT(summary_text(summary, found, Scorecard(), 1.0),
              HasSubstr("\nfound  5.5 robots a frame, a ball in 50.0 % of frames\n"));
}

TEST(Summary, SaysWhenNoFrameEverCame) {
  RunSummary summary;
  EXPECT_THAT(summary_text(summary, Found(), Scorecard(), 1.0),
              AllOf(HasSubstr("no frame ever came from the source"), Not(HasSubstr("found"))));
  summary.skipped = 1;
  EXPECT_THAT(summary_text(summary, Found(), Scorecard(), 1.0), Not(HasSubstr("no frame")));
}

TEST(Summary, TellsWhatTheColourTableTook) {
  RunSummary summary;
  EXPECT_THAT(summary_text(summary, Found(), Scorecard(), 1.0), Not(HasSubstr("colour table")));
  summary.table_compile_time = std::chrono::microseconds(123456);
  EXPECT_THAT(summary_text(summary, Found(), Scorecard(), 1.0),
              HasSubstr("colour table compiled in 123.456 ms before the run"));
}

TEST(Summary, ComparesWithTheTruthWhereThereIsOne) {
  RunSummary summary;
  summary.processed = 2;
  TrueScene scene;
  for (const int id : {0, 1}) {
    TrueRobot& robot = scene.robots.emplace_back();
    robot.identity.id = id;
    robot.position_mm = cv::Point2d(300.0 * id, 0.0);
  }
  Detections found;
  for (const int id : {0, 1, 2}) {
    RobotDetection& robot = found.robots.emplace_back();
    robot.id = id;
    robot.position_mm = cv::Point2d(300.0 * id + 3.0, 0.0);
  }
  const Field field(FieldParameters{}, {640, 480});
  Scorecard truth;
  truth.add(found, scene, field);
  found.robots.erase(found.robots.begin());
  truth.add(found, scene, field);
  const std::string text = summary_text(summary, Found(), truth, 1.0);
  EXPECT_THAT(text, AllOf(HasSubstr("ground truth of 2 frames"),
                          HasSubstr("75.00 %  (3 of 4)"),
                          HasSubstr("1.000 a frame"), HasSubstr("3.00 mm")));
}

}  // namespace
}  // namespace maggic::app
