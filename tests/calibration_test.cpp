/// Calibration as a whole: from frames alone to a file with which other frames come out right.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "maggic/calibration.hpp"
#include "maggic/runner.hpp"
#include "maggic/scorecard.hpp"
#include "maggic/testing.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;
using testing::text_of;
using ::testing::ThrowsMessage;

const std::filesystem::path kProject = MAGGIC_SOURCE_DIR;
const std::filesystem::path kFootage = kProject / ".." / "shared" / "footage";

// Sanitizer builds run 20 times slower; they look for memory errors, not for accuracy.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSlow = true;
#else
constexpr bool kIsSlow = false;
#endif
// ThreadSanitizer looks at threads; one whole calibration of each kind shows it all there are.
#if defined(__SANITIZE_THREAD__)
#define SKIP_WHERE_ONLY_THREADS_MATTER() GTEST_SKIP() << "adds no thread to what other tests run"
#else
#define SKIP_WHERE_ONLY_THREADS_MATTER() static_cast<void>(0)
#endif
constexpr int kFrames = kIsSlow ? 2 : 12;
constexpr int kOtherFrames = kIsSlow ? 10 : 100;
// Of the match; trying all of them takes longest, so only tests that are about finding it do.
constexpr int kGoodThreshold = 60;

/// A match of another seed goes another way; frames are a third of a second apart.
std::vector<cv::Mat> match_frames(int count, std::string_view more = "") {
  const StagePtr<Source> source =
      testing::make<Source>("synthetic_match", fmt::format("{{fps: 3, seed: 4{}}}", more));
  source->open();
  std::vector<cv::Mat> frames;
  Frame frame;
  while (static_cast<int>(frames.size()) < count) {
    source->read(frame);
    frames.push_back(frame.bgr.clone());
  }
  return frames;
}

/// Numbers as far off as those of another venue.
std::vector<std::string> another_venue(const std::string& pipeline) {
  if (pipeline == "legacy_3v3") {
    return {"segmenter.yuv_boxes.boxes={orange: {y: [0, 1], u: [0, 1], v: [0, 1]}}"};
  }
  return {"segmenter.hue_pivots.gray_threshold=250",
          "segmenter.hue_pivots.pivots={orange: 90, blue: 20, yellow: 200, red: 130}"};
}

CalibrationRequest request_for(const std::string& pipeline,
                               const std::vector<std::string>& assignments = {}) {
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (pipeline + ".yaml");
  request.assignments = assignments;
  std::vector<Mistake> notes;
  CalibrationRequest calibration;
  calibration.document = merged_document(request, notes);
  return calibration;
}

CalibrationResult calibrated(const CalibrationRequest& request,
                             const std::vector<cv::Mat>& frames) {
  testing::RecordingReporter reporter;
  return calibrate(request, frames, testing::registry());
}

class SyntheticCalibration : public ::testing::TestWithParam<std::string> {
 protected:
  Folder folder_;
};

TEST_P(SyntheticCalibration, MakesOtherFramesOfTheMatchComeOutRight) {
  CalibrationRequest asked = request_for(GetParam(), another_venue(GetParam()));
  if (kIsSlow) asked.gray_threshold = kGoodThreshold;
  const CalibrationResult result = calibrated(asked, match_frames(kFrames));
  ASSERT_THAT(result.yaml, Not(IsEmpty()));
  EXPECT_LT(result.before.robots, 0.5);
  EXPECT_EQ(result.after.robots, 6.0);
  EXPECT_EQ(result.after.doubtful, 0.0);
  EXPECT_EQ(result.after.balls, 1.0);

  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (GetParam() + ".yaml");
  request.assignments = another_venue(GetParam());
  request.assignments.push_back("source.synthetic_match.seed=77");
  // A calibration's numbers replace those of the file but not those of --set, so it has them.
  const std::string file = folder_.write(
      "pipeline.yaml", to_yaml(request_for(GetParam(), request.assignments).document));
  request = {.pipeline = file, .calibration = folder_.write("venue.yaml", result.yaml)};
  testing::RecordingReporter reporter;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.sinks.clear();
  Scorecard score;
  const std::atomic<bool> stop{false};
  run(built, {.max_frames = kOtherFrames}, stop, reporter,
      [&](const FrameResult& frame, const RunSummary&) {
        score.add(frame.detections, scene_of(frame.frame.truth), *built.pipeline->field());
      });
  ASSERT_EQ(score.frames(), static_cast<std::uint64_t>(kOtherFrames));
  const ObjectTally robots = score.robots();
  EXPECT_EQ(robots.right_identity, robots.frames);
  EXPECT_EQ(score.false_robots(), 0u);
  EXPECT_EQ(score.ball().seen, score.ball().frames);
  EXPECT_EQ(score.false_balls(), 0u);
  EXPECT_LE(robots.position_mm.rmse(), 2.0);
  EXPECT_LE(robots.heading_deg.rmse(), 1.5);
}

INSTANTIATE_TEST_SUITE_P(Pipelines, SyntheticCalibration,
                         ::testing::Values("maggic_3v3", "legacy_3v3"),
                         [](const auto& test) { return test.param; });

TEST(Calibration, FromOneFrameSaysThatItWasOne) {
  CalibrationRequest request = request_for("maggic_3v3");
  request.gray_threshold = kGoodThreshold;
  const CalibrationResult result = calibrated(request, match_frames(1));
  EXPECT_EQ(result.after.robots, 6.0);
  EXPECT_THAT(result.unsettled, Contains(HasSubstr("one frame only")));
}

TEST(Calibration, FindsNothingWhereThereIsNothing) {
  for (const cv::Scalar& color : {cv::Scalar(0, 0, 0), cv::Scalar(90, 90, 90)}) {
    const std::vector<cv::Mat> frames(2, cv::Mat(240, 320, CV_8UC3, color));
    const CalibrationResult result = calibrated(request_for("maggic_3v3"), frames);
    EXPECT_THAT(result.yaml, IsEmpty());
    EXPECT_THAT(result.unsettled, Contains(HasSubstr("no tags were found")));
  }
}

TEST(Calibration, OfAPictureOfOnePixelIsNone) {
  const std::vector<cv::Mat> frames{cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 255))};
  EXPECT_THAT(calibrated(request_for("maggic_3v3"), frames).yaml, IsEmpty());
}

TEST(Calibration, KeepsWhatIsGivenByHand) {
  SKIP_WHERE_ONLY_THREADS_MATTER();
  CalibrationRequest request = request_for("maggic_3v3");
  request.gray_threshold = 41;
  request.corners_px = {{{60.5, 20}, {570, 21}, {571, 455}, {62, 456}}};
  const CalibrationResult result = calibrated(request, match_frames(1));
  const Node yaml = parse_document(result.yaml, "calibration");
  EXPECT_EQ(yaml.find("segmenter")->find("hue_pivots")->find("gray_threshold")->scalar, "41");
  EXPECT_EQ(yaml.find("field")->find("corners_px")->items[0].items[0].scalar, "60.5");
  EXPECT_EQ(yaml.find("field")->find("corners_px")->items[3].items[1].scalar, "456.0");
}

TEST(Calibration, KeepsTheColoursItDidNotSee) {
  CalibrationRequest request =
      request_for("maggic_3v3", {"segmenter.hue_pivots.pivots.magenta=228"});
  request.gray_threshold = kGoodThreshold;
  const Node yaml = parse_document(calibrated(request, match_frames(1)).yaml, "calibration");
  EXPECT_EQ(yaml.find("segmenter")->find("hue_pivots")->find("pivots")->find("magenta")->scalar,
            "228");
}

TEST(Calibration, NeedsFramesOfOneSize) {
  const CalibrationRequest request = request_for("maggic_3v3");
  EXPECT_THAT([&] { calibrated(request, {}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no frame")));
  const std::vector<cv::Mat> two{cv::Mat(9, 9, CV_8UC3), cv::Mat(9, 8, CV_8UC3)};
  EXPECT_THAT([&] { calibrated(request, two); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("9x9"), HasSubstr("8x9"))));
}

/// `maggic calibrate` as its user meets it.
class CalibrateProgram : public ::testing::Test {
 protected:
  ProgramResult calibrate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"calibrate", pipeline_});
    return Program(folder_.path(), std::move(arguments)).wait();
  }
  /// Neither the file nor anything half-written beside it.
  void expect_nothing_written() const {
    EXPECT_FALSE(std::filesystem::exists(output_));
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("venue")));
    }
  }
  void save(const std::string& name, const cv::Mat& picture) const {
    cv::imwrite(folder_.file(name), picture);
  }

  Folder folder_;
  const std::string output_ = folder_.file("venue.yaml");
  const std::string pipeline_ =
      folder_.write("pipeline.yaml", text_of(kProject / "pipelines" / "maggic_3v3.yaml"));
};

TEST_F(CalibrateProgram, WritesAFileThatCanBeUsed) {
  const auto result = calibrate({"-o", output_, "--frames", "2", "--threshold", "60"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("now:    6.00 complete robots a frame"),
                                HasSubstr("--calibration " + output_)));
  const auto checked =
      Program(folder_.path(), {"check", pipeline_, "--calibration", output_}).wait();
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

TEST_F(CalibrateProgram, NeverReplacesABetterCalibrationByAWorse) {
  SKIP_WHERE_ONLY_THREADS_MATTER();
  folder_.write("venue.yaml", "segmenter: {hue_pivots: {gray_threshold: 60}}  # proven\n");
  const std::string before = text_of(output_);
  // So high that it loses the palest tags, but not all.
  const auto result =
      calibrate({"-o", output_, "--calibration", output_, "--frames", "2", "--threshold", "145"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("does worse than the numbers there are"));
  EXPECT_EQ(text_of(output_), before);
}

TEST_F(CalibrateProgram, APictureWithoutTagsGivesOneAndNoFile) {
  save("empty.png", cv::Mat(120, 160, CV_8UC3, cv::Scalar(60, 60, 60)));
  const auto result = calibrate({"-o", output_, "--source", folder_.file("empty.png")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no tags were found"), HasSubstr("nothing was written")));
  expect_nothing_written();
}

TEST_F(CalibrateProgram, ASourceWithoutFramesGivesOne) {
  const std::string video = folder_.write("empty.mp4", "");
  const auto result = calibrate({"-o", output_, "--source", video});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("empty.mp4"));
  expect_nothing_written();
}

TEST_F(CalibrateProgram, FramesOfAnotherSizeArePassedOver) {
  SKIP_WHERE_ONLY_THREADS_MATTER();
  std::filesystem::create_directory(folder_.file("stills"));
  save("stills/0.png", match_frames(1)[0]);
  save("stills/1.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(60, 60, 60)));
  const auto result =
      calibrate({"-o", output_, "--source", folder_.file("stills"), "--threshold", "60"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("another size than the first one"));
  EXPECT_THAT(text_of(output_), HasSubstr("From 1 frame"));
}

TEST_F(CalibrateProgram, AnOutputThatCannotBeOrMustNotBeWrittenGivesTwo) {
  const std::string before = text_of(pipeline_);
  const auto itself = calibrate({"-o", pipeline_});
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_THAT(itself.err, HasSubstr("would destroy the pipeline itself"));
  EXPECT_EQ(text_of(pipeline_), before);

  const auto nowhere = calibrate({"-o", folder_.file("nowhere/venue.yaml")});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, AllOf(HasSubstr("there is no folder"), HasSubstr("nowhere")));

  const auto folder = calibrate({"-o", folder_.path().string()});
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_THAT(folder.err, HasSubstr("is a folder"));

  save("still.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(60, 60, 60)));
  const auto source =
      calibrate({"-o", folder_.file("still.png"), "--source", folder_.file("still.png")});
  EXPECT_EQ(source.exit_code, 2);
  EXPECT_THAT(source.err, HasSubstr("would destroy what is looked at"));
  expect_nothing_written();
}

TEST_F(CalibrateProgram, WrongCornersGiveTwoAndSayWhatIsExpected) {
  const auto no_number = calibrate({"-o", output_, "--corners", "1,2", "9,2", "9,x", "1,8"});
  EXPECT_EQ(no_number.exit_code, 2);
  EXPECT_THAT(no_number.err, AllOf(HasSubstr("--corners: found '9,x'"), HasSubstr("39,-5")));

  const auto no_comma = calibrate({"-o", output_, "--corners", "1,2", "9,2", "98", "1,8"});
  EXPECT_EQ(no_comma.exit_code, 2);
  EXPECT_THAT(no_comma.err, HasSubstr("--corners: found '98'"));

  EXPECT_EQ(calibrate({"-o", output_, "--corners", "1,2", "9,2", "9,8"}).exit_code, 2);

  const auto no_field = calibrate({"-o", output_, "--corners", "1,2", "9,2", "1,8", "9,8"});
  EXPECT_EQ(no_field.exit_code, 2);
  EXPECT_THAT(no_field.err, AllOf(HasSubstr("--corners: "), HasSubstr("top-left")));
  expect_nothing_written();
}

TEST_F(CalibrateProgram, MistakesInThePipelineGiveTwoWithTheirPlaces) {
  const auto result = calibrate({"-o", output_, "--set", "segmenter.hue_pivots.pivots.pink=9"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("pink"));
  EXPECT_EQ(calibrate({"-o", output_, "--threshold", "256"}).exit_code, 2);
  EXPECT_EQ(calibrate({"-o", output_, "--frames", "0"}).exit_code, 2);
  EXPECT_EQ(calibrate({}).exit_code, 2) << "there is no default for what is written";
  expect_nothing_written();
}

struct FootageCase {
  std::string clip;      // <clip>.json beside its media
  std::string media;     // its ending
  std::string pipeline;  // in pipelines/
  std::string required;  // figures of `maggic score`
};

void PrintTo(const FootageCase& c, std::ostream* out) { *out << c.clip << ' ' << c.pipeline; }

class FootageCalibration : public ::testing::TestWithParam<FootageCase> {
 protected:
  Folder folder_;
};

TEST_P(FootageCalibration, MakesEveryObjectComeOutRight) {
  SKIP_WHERE_ONLY_THREADS_MATTER();
  const FootageCase& c = GetParam();
  if (!std::filesystem::exists(kFootage / (c.clip + ".json"))) {
    GTEST_SKIP() << "no footage at " << kFootage;
  }
  if (kIsSlow && c.clip != "rinobot_1") GTEST_SKIP() << "one clip is enough for a sanitizer";
  const std::string media = kFootage / (c.clip + c.media);
  const std::string venue = folder_.file("venue.yaml");
  const auto calibrated = Program(folder_.path(), {"calibrate", c.pipeline, "--source", media,
                                                   "--output", venue, "--frames", "12"})
                              .wait(std::chrono::seconds(300));
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.err << calibrated.out;
  const auto scored =
      Program(folder_.path(),
              {"score", c.pipeline, "--source", media, "--truth", kFootage / (c.clip + ".json"),
               "--calibration", venue, "--frames", kIsSlow ? "10" : "60", "--require",
               "frames_right=99,false=0," + c.required})
          .wait();
  EXPECT_EQ(scored.exit_code, 0) << scored.err << scored.out << text_of(venue);
}

INSTANTIATE_TEST_SUITE_P(
    Clips, FootageCalibration,
    ::testing::Values(
        FootageCase{"static", ".mp4", "maggic_3v3", "ball_seen=99,heading_p95_deg=10"},
        FootageCase{"static", ".mp4", "legacy_3v3", "ball_seen=99,heading_p95_deg=10"},
        FootageCase{"rinobot_1", ".jpg", "maggic_3v3", "ball_seen=100,corners_px=5"},
        FootageCase{"rinobot_1", ".jpg", "legacy_3v3", "ball_seen=100,corners_px=5"},
        FootageCase{"vsssdk_model_3908ae", ".jpg", "diagonal_tags", "ball_seen=100"},
        FootageCase{"all_tags", ".mp4", "maggic_3v3_three_tag", "heading_p95_deg=5"},
        FootageCase{"tags_3v3_0", ".mp4", "maggic_3v3_three_tag", "heading_p95_deg=5"},
        FootageCase{"tags_3v3_1", ".mp4", "maggic_3v3_three_tag", "heading_p95_deg=5"}),
    [](const auto& test) { return test.param.clip + "_" + test.param.pipeline; });

}  // namespace
}  // namespace maggic
