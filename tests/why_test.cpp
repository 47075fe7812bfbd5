/// `--why X,Y` and the notes on doubtful borders, as a user meets them.

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

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

/// A picture with a blue half beside a red one, as a two-tag robot wears them, and a small red
/// speck.
std::string robot_picture() {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  std::string ppm = "P6 320 240 255\n";
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_tag = y >= 100 && y < 114;
      const bool red = (in_tag && x >= 107 && x < 114) || (y == 50 && x >= 50 && x < 52);
      const bool blue = in_tag && x >= 100 && x < 107;
      ppm += red ? '\xC8' : '\x28';
      ppm += '\x28';
      ppm += blue ? '\xC8' : '\x28';
    }
  }
  return ppm;
}

class WhyTest : public ::testing::Test {
 protected:
  ProgramResult maggic(std::vector<std::string> arguments) {
    return Program(folder_.path(), std::move(arguments)).wait();
  }
  ProgramResult run(std::vector<std::string> more) {
    std::vector<std::string> arguments{"run", pipeline_, "--source", picture_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return maggic(std::move(arguments));
  }

  Folder folder_;
  const std::string picture_ = folder_.write("field.ppm", robot_picture());
  const std::string pipeline_ =
      folder_.write("pipeline.yaml",
                    "source: {synthetic_match: {}}\n"
                    "normalizer: weighted\n"
                    "segmenter: {hue_pivots: {gray_threshold: 60, pivots: {orange: 14, blue: 160, "
                    "yellow: 38, red: 252}}}\n"
                    "tracker: two_tag\n");
};

TEST_F(WhyTest, FollowsATagFromItsColorToItsRobot) {
  const auto result = run({"--why", "103,106", "--why", "110.4,106"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("why 103,106 in frame 0"), HasSubstr("pixel       RGB 40 40 200, hue 171"),
            HasSubstr("normalized  RGB 7 7 192 by weighted"),
            HasSubstr("label       blue: hue 171 of the original colour is "
                      "nearest to blue's pivot 160 (11 away)"),
            HasSubstr("blob        98 px"), HasSubstr("tracker     team patch of blue robot 0 at "),
            HasSubstr("tracker     player patch 1 of blue robot 0 at ")));
}

TEST_F(WhyTest, NamesTheGrayFilterTheBlobLimitAndThePictureBeside) {
  const auto result = run({"--why", "10,10", "--why", "51,50", "--why", "103,98"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("background: gray: the channels are all equal"),
                                HasSubstr("dropped: smaller than blobs.min_area_mm2"),
                                HasSubstr("the nearest coloured pixel is blue at 103,100")));
}

TEST_F(WhyTest, SaysThatAPointLiesBeyondTheFieldsMargin) {
  // 3v3, 5 mm a pixel: the picture's left rim is 50 mm beyond the line.
  const std::vector<std::string> beyond{
      "--why", "0,120",
      "--set", "field.corners_px=[[10, -10], [310, -10], [310, 250], [10, 250]]",
      "--set", "scan.margin_mm=0"};
  const auto result = run(beyond);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("scan   not looked at: beyond the field: "),
                                HasSubstr(" mm outside the lines, scan.margin_mm is 0\n"),
                                Not(HasSubstr("label"))));
  auto within = beyond;
  within.back() = "scan.margin_mm=50";
  EXPECT_THAT(run(within).out, AllOf(HasSubstr("label  "), Not(HasSubstr("not looked at"))));
}

TEST_F(WhyTest, SaysThatAPredictedSearchDidNotLookAtAPointInThisFrame) {
  // The first 8 frames are looked at as a whole; in the ninth the top rows have their turn.
  std::filesystem::create_directory(folder_.path() / "pictures");
  for (int i = 0; i < 9; ++i) folder_.write(fmt::format("pictures/{}.ppm", i), robot_picture());
  std::vector<std::string> asked{"run",   pipeline_, "--source", folder_.path() / "pictures",
                                 "--why", "300,230", "--set",    "scan.search=predicted"};
  const auto result = maggic(asked);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("why 300,230 in frame 8"), HasSubstr("scan   not looked at in this frame"),
            HasSubstr("within scan.unseen_frames, 8 frames"), Not(HasSubstr("background"))));
  for (const char* looked_at : {"300,5", "103,106"}) {
    asked[5] = looked_at;
    EXPECT_THAT(maggic(asked).out, AllOf(HasSubstr("label  "), Not(HasSubstr("not looked at"))));
  }
  asked[5] = "300,230";
  asked.back() = "scan.search=full";
  EXPECT_THAT(maggic(asked).out,
              AllOf(HasSubstr("background: gray"), Not(HasSubstr("not looked at"))));
}

TEST_F(WhyTest, AnswersForTheFrameAskedFor) {
  const auto result = maggic({"run", pipeline_, "--source", "synthetic", "--frames", "5", "--why",
                              "320,240", "--why-frame", "2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("why 320,240 in frame 2\n"));
  const auto last =
      maggic({"run", pipeline_, "--source", "synthetic", "--frames", "5", "--why", "320,240"});
  EXPECT_THAT(last.out, HasSubstr("why 320,240 in frame 4\n"));
}

TEST_F(WhyTest, RefusesPointsAndFramesThatAreNotThere) {
  const auto outside = run({"--why", "320,10"});
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.err,
              HasSubstr("--why: 320,10 lies outside of the picture, which is 320 × 240 "
                        "pixels"));
  const auto below = run({"--why=-1,10"});
  EXPECT_EQ(below.exit_code, 2);
  const auto late = run({"--why", "3,3", "--why-frame", "7"});
  EXPECT_EQ(late.exit_code, 2);
  EXPECT_THAT(late.err, HasSubstr("frame 7 was never processed; the last one was 0"));
  for (const char* point : {"3", "3,", "a,b", "3,4,5", "nan,1", "1e9,1"}) {
    const auto malformed = run({"--why", point});
    EXPECT_EQ(malformed.exit_code, 2) << point;
    EXPECT_THAT(malformed.err, HasSubstr("expected a point of the picture in pixels: X,Y"));
  }
  const auto lone = run({"--why-frame", "0"});
  EXPECT_EQ(lone.exit_code, 2);
}

TEST_F(WhyTest, AnswersBesideAScoreToo) {
  const std::string truth = folder_.write(
      "truth.json",
      R"({"size_px": [320, 240], "tolerance_px": 3, "ball": null, "robots": [{"team": "blue",
          "player_colors": ["red"], "x": 106.5, "y": 106.5, "heading_deg": 180,
          "tags": [{"color": "blue", "x": 103, "y": 106.5}, {"color": "red", "x": 110, "y": 106.5}]}]})");
  const auto result =
      maggic({"score", pipeline_, "--source", picture_, "--truth", truth, "--why", "103,106"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("tracker     team patch of blue robot 0"));
}

TEST_F(WhyTest, ABorderThroughATagsColorIsANote) {
  // Red at hue 0: the border between orange 14 and red 244 lies at 1.
  const auto cut =
      run({"--set", "segmenter.hue_pivots.pivots.red=244", "--set", "blobs.min_area_mm2=0"});
  EXPECT_EQ(cut.exit_code, 0);
  EXPECT_THAT(cut.err, HasSubstr("note: the border between orange and red at hue"));
  const auto checked = maggic(
      {"check", pipeline_, "--source", picture_, "--set", "segmenter.hue_pivots.pivots.red=244"});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_THAT(checked.err, HasSubstr("note: the border between orange and red at hue"));
  const auto clean = maggic({"check", pipeline_, "--source", picture_});
  EXPECT_THAT(clean.err, Not(HasSubstr("border")));
}

TEST_F(WhyTest, CheckSaysWhenItCouldNotLook) {
  const std::string broken = folder_.write("broken.png", "no picture");
  const auto result = maggic({"check", pipeline_, "--source", broken});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("note: colours were not looked at: "));
  EXPECT_THAT(result.out, HasSubstr("ok\n"));
}

}  // namespace
}  // namespace maggic
