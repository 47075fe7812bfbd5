#include "studio/session/live_session.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "maggic/runner.hpp"
#include "maggic/testing.hpp"
#include "studio/session/color_settings.hpp"
#include "tests/temporary_folder.hpp"

namespace maggic::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr milliseconds kLong{10'000};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The synthetic match running through a copy of a pipeline, with a session on it, in a folder of
/// its own.
class Running {
 public:
  /// @param pace kRecorded: as fast as it goes, and nothing may be dropped.
  enum class Pace { kRealtime, kRecorded };
  explicit Running(const std::string& calibration = "", Pace pace = Pace::kRealtime,
                   int frames = 100'000) {
    fs::current_path(folder_.path());
    std::ofstream(pipeline_) << kPipeline;
    request_.assignments = {"source.synthetic_match.frames=" + std::to_string(frames)};
    request_.pipeline = pipeline_;
    if (!calibration.empty()) {
      std::ofstream("venue.yaml") << calibration;
      request_.calibration = folder_.path() / "venue.yaml";
    }
    built_ = build_pipeline(request_, testing::registry(), reporter_);
    session_ =
        std::make_unique<LiveSession>(request_, built_, testing::registry(), reporter_, stop_);
    run_ = std::thread([this, pace] {
      summary_ = run(built_, {.realtime = pace == Pace::kRealtime}, stop_, reporter_,
                     [this](const FrameResult& result, const RunSummary& so_far) {
                       session_->on_frame(result, so_far);
                     });
    });
  }
  ~Running() {
    end();
    session_.reset();
    fs::current_path(before_);
  }

  void wait_for_the_sources_end() { run_.join(); }

  const RunSummary& end() {
    stop_ = true;
    if (run_.joinable()) run_.join();
    return summary_;
  }

  LiveSession& session() { return *session_; }
  const fs::path& pipeline() const { return pipeline_; }
  fs::path folder() const { return folder_.path(); }

  /// Settings of the pipeline that `calibration` makes of the file, as a program started anew has
  /// them.
  json settings_with(const fs::path& calibration) {
    PipelineRequest request = request_;
    request.calibration = calibration;
    const BuiltPipeline built = build_pipeline(request, testing::registry(), reporter_);
    return color_settings(color_stages(built.pipeline->parts()));
  }

 private:
  static constexpr const char* kPipeline = R"(
source: {synthetic_match: {width: 320, height: 240}}
normalizer: weighted
segmenter:
  hue_pivots:
    gray_threshold: 60
    pivots: {orange: 14, blue: 160, yellow: 38, red: 252, green: 100, cyan: 136}
field: {format: 3v3}
tracker: two_tag
)";

  const fs::path before_ = fs::current_path();
  testing::Folder folder_;
  const fs::path pipeline_ = fs::path(folder_.path()) / "match.yaml";
  testing::RecordingReporter reporter_;
  PipelineRequest request_;
  BuiltPipeline built_;
  std::atomic<bool> stop_{false};
  std::unique_ptr<LiveSession> session_;
  std::thread run_;
  RunSummary summary_;
};

/// What is thrown when something is refused.
template <class Action>
BadRequest refused(Action action) {
  try {
    action();
  } catch (const BadRequest& e) {
    return e;
  }
  ADD_FAILURE() << "nothing was refused";
  return {500, "nothing was refused"};
}

std::optional<json> next_event(LiveSession& session, const std::string& name) {
  std::uint64_t after = 0;
  const auto end = std::chrono::steady_clock::now() + kLong;
  while (std::chrono::steady_clock::now() < end) {
    const std::optional<Event> event = session.next_event(after, milliseconds(500));
    if (!event) continue;
    after = event->number;
    if (event->name == name) return json::parse(event->data);
  }
  return {};
}

TEST(LiveSession, TellsOfThePipelineAndItsColours) {
  Running running;
  const json colors = running.session().colors();
  EXPECT_EQ(colors["normalizer"], "weighted");
  EXPECT_EQ(colors["gray_threshold"], 60);
  EXPECT_EQ(colors["hue_of"], "original");
  EXPECT_EQ(colors["pivots"]["red"], json({252}));
  EXPECT_EQ(colors["unsaved"], false);
  ASSERT_TRUE(next_event(running.session(), "frame"));
  const json state = running.session().state();
  EXPECT_EQ(state["pipeline"], "match");
  EXPECT_EQ(state["source"]["width"], 320);
  EXPECT_THAT(state["normalizers"].get<std::vector<std::string>>(), Contains("vector"));
}

TEST(LiveSession, AChangeIsInUseWhenItIsAnsweredAndNoFrameIsLost) {
  Running running("", Running::Pace::kRecorded);
  LiveSession& session = running.session();
  ASSERT_TRUE(next_event(session, "frame"));
  // Orange at cyan's hue and cyan elsewhere: what was cyan is orange now.
  json pivots = session.colors()["pivots"];
  pivots["cyan"] = json::array({190});
  pivots["orange"] = json::array({136});
  const json changed = session.change_colors({{"pivots", pivots}});
  EXPECT_EQ(changed["pivots"]["orange"], json({136}));
  EXPECT_EQ(changed["undo"], 1);
  EXPECT_EQ(changed["unsaved"], true);
  const json undone = session.undo();
  EXPECT_EQ(undone["pivots"]["orange"], json({14}));
  EXPECT_EQ(session.redo()["pivots"]["orange"], json({136}));
  const RunSummary& summary = running.end();
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  EXPECT_EQ(summary.sinks.at(0).written, summary.processed);
}

TEST(LiveSession, TheTableThatIsShownIsTheOneInUse) {
  Running running;
  const json before = running.session().plane();
  json pivots = running.session().colors()["pivots"];
  pivots["red"] = json::array({230});
  running.session().change_colors({{"pivots", pivots}});
  EXPECT_NE(running.session().plane(), before);
  running.session().undo();
  EXPECT_EQ(running.session().plane(), before);
}

TEST(LiveSession, ADragIsOneStepOfUndo) {
  Running running;
  LiveSession& session = running.session();
  json pivots = session.colors()["pivots"];
  for (const int hue : {250, 248, 246}) {
    pivots["red"] = json::array({hue});
    session.change_colors({{"pivots", pivots}});
  }
  EXPECT_EQ(session.change_colors({{"gray_threshold", 50}})["undo"], 2);
  EXPECT_EQ(session.undo()["pivots"]["red"], json({246}));
  EXPECT_EQ(session.undo()["pivots"]["red"], json({252}));
  EXPECT_EQ(session.redo()["pivots"]["red"], json({246}));
}

TEST(LiveSession, PivotsThatNobodyNamedAreShownAllTheSame) {
  Running running;
  json colors = running.session().change_colors({{"pivots", nullptr}});
  EXPECT_EQ(colors["pivots"]["yellow"], json({43}));
}

TEST(LiveSession, AMistakeIsToldAndChangesNothing) {
  Running running;
  LiveSession& session = running.session();
  const BadRequest range = refused([&] { session.change_colors({{"gray_threshold", 300}}); });
  EXPECT_EQ(range.status(), 422);
  EXPECT_THAT(range.what(), HasSubstr("300 is out of range"));
  EXPECT_EQ(range.body()["mistakes"][0]["key"], "segmenter.hue_pivots.gray_threshold");
  EXPECT_EQ(refused([&] { session.change_colors({{"pivots", {{"pink", {1}}}}}); }).status(), 422);
  EXPECT_EQ(refused([&] { session.change_colors({{"boxes", json::object()}}); }).status(), 422);
  EXPECT_EQ(refused([&] { session.change_colors({{"normalizer", "wishful"}}); }).status(), 422);
  EXPECT_EQ(refused([&] { session.change_colors(json::array()); }).status(), 422);
  EXPECT_EQ(refused([&] { session.undo(); }).status(), 409);
  EXPECT_EQ(session.colors()["gray_threshold"], 60);
  EXPECT_EQ(session.colors()["undo"], 0);
}

TEST(LiveSession, AChangeOfWhatIsOldByNowIsRefused) {
  Running running;
  LiveSession& session = running.session();
  const json seen = session.colors();
  session.change_colors({{"gray_threshold", 50}, {"revision", seen["revision"]}});
  const BadRequest late = refused([&] {
    session.change_colors({{"gray_threshold", 40}, {"revision", seen["revision"]}});
  });
  EXPECT_EQ(late.status(), 409);
  EXPECT_EQ(session.colors()["gray_threshold"], 50);
}

TEST(LiveSession, NormalizersCanBeTriedOneAfterTheOther) {
  Running running;
  EXPECT_EQ(running.session().change_colors({{"normalizer", "vector"}})["normalizer"], "vector");
  EXPECT_EQ(running.session().undo()["normalizer"], "weighted");
}

TEST(LiveSession, EveryViewIsAPictureOfTheFrame) {
  Running running;
  for (const std::string& view : running.session().views()) {
    const auto picture = running.session().next_picture(view, 0, 0, kLong);
    ASSERT_NE(picture, nullptr) << view;
    const cv::Mat decoded = cv::imdecode(picture->jpeg, cv::IMREAD_COLOR);
    EXPECT_EQ(decoded.size(), cv::Size(320, 240)) << view;
  }
  const auto narrow = running.session().next_picture("labels", 160, 0, kLong);
  ASSERT_NE(narrow, nullptr);
  EXPECT_EQ(cv::imdecode(narrow->jpeg, cv::IMREAD_COLOR).size(), cv::Size(160, 120));
}

TEST(LiveSession, ExplainsAPixelThroughEveryStage) {
  Running running;
  const json answer = running.session().explain(160, 120);
  EXPECT_EQ(answer["rgb"].size(), 3u);
  EXPECT_THAT(answer["answers"].dump(), HasSubstr("\"normalized\""));
  EXPECT_EQ(refused([&] { running.session().explain(320, 0); }).status(), 422);
}

TEST(LiveSession, TellsTheHueThatTheSegmenterJudgesBy) {
  Running running;
  LiveSession& session = running.session();
  ASSERT_TRUE(next_event(session, "frame"));
  session.pause({{"paused", true}});
  // With a change the frame that is held is shown anew, at the latest when the next one is taken.
  session.change_colors({{"gray_threshold", 55}});
  session.change_colors({{"gray_threshold", 56}});
  const auto picture = session.next_picture("labels", 0, 0, kLong);
  ASSERT_NE(picture, nullptr);
  // The middle of something: as bright all around, whatever JPEG does to edges.
  cv::Mat brightness;
  cv::reduce(cv::imdecode(picture->jpeg, cv::IMREAD_COLOR).reshape(1, 320 * 240), brightness, 1,
             cv::REDUCE_MAX);
  cv::erode(brightness.reshape(1, 240), brightness, cv::Mat::ones(5, 5, CV_8UC1));
  cv::Point middle;
  cv::minMaxLoc(brightness, nullptr, nullptr, nullptr, &middle);
  const json answer = session.explain(middle.x, middle.y);
  ASSERT_TRUE(answer["hue"].is_number()) << answer;
  EXPECT_THAT(answer["answers"].dump(),
              HasSubstr("hue " + std::to_string(answer["hue"].get<int>()) + " of the original"));
}

TEST(LiveSession, ShowsWhereTheFramesColoursLie) {
  Running running;
  ASSERT_NE(running.session().next_picture("original", 0, 0, kLong), nullptr);
  const json density = running.session().density();
  EXPECT_EQ(density["hue_value"]["width"], 256);
  EXPECT_EQ(density["hue_value"]["height"], 128);
  EXPECT_THAT(density["hue_value"]["counts"].get<std::string>(), HasSubstr("/"))
      << "255, the most, is somewhere";
}

TEST(LiveSession, WhatIsSavedMakesThePipelineWhatItIs) {
  Running running;
  LiveSession& session = running.session();
  json pivots = session.colors()["pivots"];
  pivots.erase("cyan");
  pivots["green"] = json::array({95, 105});
  session.change_colors({{"pivots", pivots}, {"gray_threshold", 45}});
  const json saved = session.save({{"file", "venue.yaml"}});
  EXPECT_EQ(saved["file"], (running.folder() / "venue.yaml").string());
  EXPECT_EQ(session.colors()["unsaved"], false);
  const json anew = running.settings_with(running.folder() / "venue.yaml");
  EXPECT_EQ(anew["pivots"], pivots);
  EXPECT_EQ(anew["gray_threshold"], 45);
}

TEST(LiveSession, SavingKeepsWhatElseACalibrationHolds) {
  Running running("field: {corners_px: [[10, 10], [300, 10], [300, 230], [10, 230]]}\n");
  running.session().change_colors({{"gray_threshold", 45}});
  running.session().save(json::object());
  EXPECT_THAT(text_of(running.folder() / "venue.yaml"), HasSubstr("corners_px"));
}

TEST(LiveSession, SavesNowhereElseThanBelowItsFolder) {
  Running running;
  LiveSession& session = running.session();
  for (const char* file : {"../elsewhere.yaml", "/tmp/elsewhere.yaml", "a/../../b.yaml",
                           "notes.txt", "", "match.yaml"}) {
    EXPECT_EQ(refused([&] { session.save({{"file", file}}); }).status(), 422) << file;
  }
  EXPECT_EQ(refused([&] { session.save(json::object()); }).status(), 422) << "where to?";
  EXPECT_THAT(text_of(running.pipeline()), HasSubstr("gray_threshold: 60"));
}

TEST(LiveSession, AFileEditedOutsideIsTakenOverAndABadEditIsNot) {
  Running running;
  LiveSession& session = running.session();
  std::string text = text_of(running.pipeline());
  const auto write = [&](const std::string& threshold) {
    std::string edited = text;
    edited.replace(edited.find("gray_threshold: 60"), 18, "gray_threshold: " + threshold);
    std::ofstream(running.pipeline()) << edited;
  };
  write("33");
  const auto end = std::chrono::steady_clock::now() + kLong;
  while (session.colors()["gray_threshold"] != 33 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(milliseconds(20));
  }
  EXPECT_EQ(session.colors()["gray_threshold"], 33);
  write("nonsense");
  std::optional<json> message;
  do {
    message = next_event(session, "message");
    ASSERT_TRUE(message);
  } while ((*message)["level"] != "error");
  EXPECT_THAT((*message)["text"].get<std::string>(), HasSubstr("match.yaml"));
  EXPECT_EQ(session.colors()["gray_threshold"], 33);
}

TEST(LiveSession, PausedItStillAnswersAndTakesChanges) {
  Running running;
  LiveSession& session = running.session();
  ASSERT_TRUE(next_event(session, "frame"));
  EXPECT_EQ(session.pause({{"paused", true}})["running"], false);
  EXPECT_EQ(session.change_colors({{"gray_threshold", 40}})["gray_threshold"], 40);
  EXPECT_THAT(session.explain(1, 1)["answers"], Not(IsEmpty()));
  EXPECT_EQ(refused([&] { session.pause(json::object()); }).status(), 422);
  EXPECT_EQ(session.pause({{"paused", false}})["running"], true);
  EXPECT_EQ(refused([&] { session.step(); }).status(), 409);
}

TEST(LiveSession, WhenTheSourceHasEndedTheLastFrameCanStillBeAskedAndTuned) {
  Running running("", Running::Pace::kRecorded, 30);
  LiveSession& session = running.session();
  running.wait_for_the_sources_end();
  const std::jthread stays([&] { session.stay_with_last_frame(); });
  EXPECT_EQ(session.change_colors({{"gray_threshold", 40}})["gray_threshold"], 40);
  EXPECT_THAT(session.explain(1, 1)["answers"], Not(IsEmpty()));
  EXPECT_NE(session.next_picture("labels", 0, 0, kLong), nullptr);
  running.end();
}

TEST(LiveSession, APausedRunEndsWhenItIsStopped) {
  Running running;
  ASSERT_TRUE(next_event(running.session(), "frame"));
  running.session().pause({{"paused", true}});
  EXPECT_TRUE(running.end().clean());
}

}  // namespace
}  // namespace maggic::studio
