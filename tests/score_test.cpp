/// `maggic score` as its user meets it.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;
using testing::text_of;
using Json = nlohmann::json;

const std::filesystem::path kFootage =
    std::filesystem::path(MAGGIC_SOURCE_DIR) / ".." / "shared" / "footage";

class ScoreTest : public ::testing::Test {
 protected:
  ProgramResult score(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"score", pipeline_});
    return Program(folder_.path(), std::move(arguments)).wait();
  }

  /// A picture without anything in it.
  std::string empty_picture() const {
    return folder_.write("empty.ppm", "P6 640 480 255\n" + std::string(3 * 640 * 480, '('));
  }

  Folder folder_;
  const std::string pipeline_ = folder_.write("pipeline.yaml",
                                              "source: {synthetic_match: {}}\n"
                                              "normalizer: weighted\n"
                                              "segmenter: {hue_pivots: {pivots: {orange: 14, "
                                              "blue: 160, yellow: 38, red: 252, green: 100, cyan: "
                                              "136, magenta: 230}}}\n"
                                              "field: {corners_px: [[64.5, 18.5], [574.5, 18.5], "
                                              "[574.5, 460.5], [64.5, 460.5]]}\n"
                                              "tracker: two_tag\n"
                                              "sinks: [{jsonl: {path: precious.jsonl}}]\n");
};

TEST_F(ScoreTest, ComparesWithTheSourcesOwnTruth) {
  const std::string json_file = folder_.file("score.json");
  const auto result = score({"--frames", "30", "--json", json_file, "--require",
                             "frames_right=100,false=0,false_balls=0,position_p95_mm=2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("30 frames judged against the source's own truth"),
                                HasSubstr("blue 0"), HasSubstr("yellow 2"), HasSubstr("ball"),
                                HasSubstr("frame path")));
  const Json json = Json::parse(text_of(json_file));
  EXPECT_EQ(json.at("schema"), "maggic-score-1");
  EXPECT_EQ(json.at("frames").at("judged"), 30);
  EXPECT_EQ(json.at("tolerance").at("unit"), "mm");
  EXPECT_EQ(json.at("figures").at("seen"), 100.0);
  EXPECT_TRUE(json.at("figures").at("corners_px").is_null());
  EXPECT_EQ(json.at("objects").size(), 7u);
  EXPECT_EQ(json.at("objects").at(6).at("name"), "ball");
  EXPECT_FALSE(json.at("objects").at(6).at("figures").contains("identity"));
}

TEST_F(ScoreTest, LeavesThePipelinesOwnOutputsAlone) {
  folder_.write("precious.jsonl", "the last match");
  EXPECT_EQ(score({"--frames", "2"}).exit_code, 0);
  EXPECT_EQ(text_of(folder_.file("precious.jsonl")), "the last match");
}

TEST_F(ScoreTest, FiguresBelowTheirRequirementGiveOneAndALineEach) {
  const auto result = score({"--frames", "3", "--require", "seen=101,false=0,track_p50_ms=0"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("not met: seen: 100 %, required at least 101 %"),
                    HasSubstr("not met: track_p50_ms: "), Not(HasSubstr("not met: false"))));
}

TEST_F(ScoreTest, AnUnknownFigureIsAnsweredWithTheKnownOnesBeforeAnythingRuns) {
  const auto result = score({"--require", "sene=99"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("did you mean 'seen'?"), HasSubstr("jitter_mm")));
  EXPECT_EQ(result.out, "");
}

TEST_F(ScoreTest, ASourceWithoutTruthNeedsAFile) {
  const auto result = score({"--source", empty_picture()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("expected --truth FILE"));
}

TEST_F(ScoreTest, CountsWhatAFileSaysIsThere) {
  const std::string truth = folder_.write("truth.json", R"({"size_px": [640, 480],
    "tolerance_px": 3, "frames": [{"frame": 0, "ball": {"x": 10, "y": 10}, "robots": [
      {"team": "blue", "id": 0, "x": 100, "y": 100}]}]})");
  const std::string json = folder_.file("score.json");
  const auto result = score({"--source", empty_picture(), "--truth", truth, "--json", json});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json figures = Json::parse(text_of(json)).at("figures");
  EXPECT_EQ(figures.at("missed"), 100.0);
  EXPECT_EQ(figures.at("ball_missed"), 100.0);
  EXPECT_EQ(figures.at("false"), 0.0);
  EXPECT_TRUE(figures.at("position_rmse_mm").is_null());
}

TEST_F(ScoreTest, TheTruthOfAnotherSizeGivesTwo) {
  const std::string truth = folder_.write(
      "truth.json", R"({"size_px": [320, 240], "tolerance_px": 3, "ball": null, "robots": []})");
  const auto result = score({"--source", empty_picture(), "--truth", truth});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr(truth), HasSubstr("found 320 x 240"),
                                HasSubstr("frames of 640 x 480")));
}

TEST_F(ScoreTest, TheTruthOfAnotherRecordingIsDoubted) {
  const std::string truth =
      folder_.write("truth.json", R"({"media": "other.mp4", "size_px": [640, 480],
                                      "tolerance_px": 3, "ball": null, "robots": []})");
  const auto result = score({"--source", empty_picture(), "--truth", truth});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("is the truth of 'other.mp4', but the source reads"));
}

TEST_F(ScoreTest, TruthForFramesThatNeverCameGivesTwo) {
  const std::string truth = folder_.write("truth.json", R"({"size_px": [640, 480],
    "tolerance_px": 3, "frames": [{"frame": 99, "ball": null, "robots": []}]})");
  const auto result = score({"--source", empty_picture(), "--truth", truth});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("none of the 1 frames is in " + truth));
}

TEST_F(ScoreTest, MistakesInTheTruthGiveTwoWithTheirPlaces) {
  const std::string bad = folder_.write("bad.json", "{\"size_px\": [1,\n}");
  const auto broken = score({"--truth", bad});
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.err, HasSubstr(bad + ":2:1: "));

  const std::string color = folder_.write("color.json", R"({"size_px": [640, 480],
    "tolerance_px": 3, "ball": null,
    "robots": [{"team": "blue", "x": 1, "y": 2, "player_colors": ["pink"]}]})");
  const auto unknown = score({"--truth", color});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err,
              AllOf(HasSubstr("/robots/0/player_colors/0: found 'pink'"), HasSubstr("magenta")));

  const auto gone = score({"--truth", folder_.file("gone.json")});
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_THAT(gone.err, HasSubstr("gone.json: no such file"));
}

TEST_F(ScoreTest, ASourceThatGivesNoFrameGivesOne) {
  const std::string truth = folder_.write(
      "truth.json", R"({"size_px": [640, 480], "tolerance_px": 3, "ball": null, "robots": []})");
  const std::string video = folder_.write("empty.mp4", "");
  const auto result = score({"--source", video, "--truth", truth});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("empty.mp4"));
}

TEST_F(ScoreTest, TheReportNeverReplacesWhatIsRead) {
  const std::string before = text_of(pipeline_);
  const auto result = score({"--frames", "2", "--json", pipeline_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--json"), HasSubstr(pipeline_)));
  EXPECT_EQ(text_of(pipeline_), before);
  const auto nowhere = score({"--frames", "2", "--json", folder_.file("nowhere/s.json")});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("does not exist"));
}

TEST_F(ScoreTest, CtrlCEndsItWithTheFiguresSoFar) {
  Program program(folder_.path(), {"score", pipeline_});
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const std::string err = folder_.file("stderr.txt");
  while (text_of(err).find("frame ") == std::string::npos &&
         std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("frames judged"));
}

TEST_F(ScoreTest, JudgesRecordedFootageByItsAnnotation) {
  if (!std::filesystem::exists(kFootage)) GTEST_SKIP() << "no footage at " << kFootage;
  const std::string clip = kFootage / "rinobot_1";
  const std::string json = folder_.file("score.json");
  const auto result =
      Program(folder_.path(), {"score", "maggic_3v3", "--source", clip + ".jpg", "--truth",
                               clip + ".json", "--calibration", "rinobot_1", "--json", json,
                               "--require", "frames_right=100,position_p95_px=1,corners_px=1"})
          .wait();
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("1 frame judged"));
  EXPECT_TRUE(Json::parse(text_of(json)).at("figures").at("jitter_mm").is_null());
}

}  // namespace
}  // namespace maggic
