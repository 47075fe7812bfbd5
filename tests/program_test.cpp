/// The program as its user meets it: exit codes, messages with their places, complete outputs.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::EndsWith;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;
using ::testing::StartsWith;
using testing::text_of;

constexpr const char* kPipeline =
    "source: {synthetic_match: {}}\n"
    "segmenter: hue_pivots\n"
    "tracker: two_tag\n";

class ProgramTest : public ::testing::Test {
 protected:
  ProgramResult maggic(std::vector<std::string> arguments) {
    return Program(folder_.path(), std::move(arguments)).wait();
  }

  Folder folder_;
  const std::string pipeline_ = folder_.write("pipeline.yaml", kPipeline);
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Until a running program has written so many lines.
void wait_for_lines(const std::string& file, std::size_t count) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (lines_of(text_of(file)).size() < count && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST_F(ProgramTest, RunsAPipelineToItsFrameLimitAndSumsUp) {
  const std::string output = folder_.file("out.jsonl");
  const auto result = maggic({"run", pipeline_, "--frames", "20", "--output", output});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("20 frames in"), HasSubstr("frame path"),
                    HasSubstr("found  6.0 robots a frame, a ball in 100.0 % of frames"),
                    HasSubstr("ground truth of 20 frames"), HasSubstr("jsonl  20  frames")));
  EXPECT_EQ(lines_of(text_of(output)).size(), 20U);
}

TEST_F(ProgramTest, TheSyntheticMatchGivesTheSameLinesEveryTime) {
  for (const char* name : {"first.jsonl", "second.jsonl"}) {
    const auto result =
        maggic({"run", pipeline_, "--frames", "40", "--output", folder_.file(name)});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const std::string first = text_of(folder_.file("first.jsonl"));
  EXPECT_THAT(first, Not(IsEmpty()));
  EXPECT_EQ(first, text_of(folder_.file("second.jsonl")));
}

TEST_F(ProgramTest, DurationIsMeasuredInTheSourcesTime) {
  const std::string output = folder_.file("out.jsonl");
  const auto result = maggic({"run", pipeline_, "--duration", "0.5", "--output", output});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto lines = lines_of(text_of(output));
  ASSERT_FALSE(lines.empty());
  const std::string last = lines.back();
  const double seconds = std::stod(last.substr(last.find("\"t_capture\":") + 12));
  EXPECT_LT(seconds, 0.5);
  EXPECT_GT(seconds, 0.4);
}

TEST_F(ProgramTest, JsonLinesOnStandardOutputStandAlone) {
  const auto result = maggic({"run", pipeline_, "--frames", "5", "--output", "-"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto lines = lines_of(result.out);
  EXPECT_EQ(lines.size(), 5U);
  for (const std::string& line : lines) {
    EXPECT_THAT(line, AllOf(StartsWith("{\"frame\":"), EndsWith("}")));
  }
  EXPECT_THAT(result.err, HasSubstr("5 frames in"));
}

TEST_F(ProgramTest, CtrlCEndsTheRunWithCompleteOutputs) {
  const std::string output = folder_.file("out.jsonl");
  Program program(folder_.path(), {"run", pipeline_, "--output", output});
  wait_for_lines(output, 5);
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string text = text_of(output);
  EXPECT_THAT(text, EndsWith("}\n"));
  const auto lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_THAT(lines[i], StartsWith("{\"frame\":" + std::to_string(i) + ","));
    EXPECT_THAT(lines[i], EndsWith("}"));
  }
  EXPECT_THAT(result.out, HasSubstr(std::to_string(lines.size()) + " frames in"));
}

TEST_F(ProgramTest, AHangUpEndsTheRunInOrderToo) {
  const std::string output = folder_.file("out.jsonl");
  Program program(folder_.path(), {"run", pipeline_, "--output", output});
  wait_for_lines(output, 5);
  program.send(SIGHUP);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string text = text_of(output);
  EXPECT_THAT(text, EndsWith("}\n"));
  EXPECT_THAT(result.out, HasSubstr(std::to_string(lines_of(text).size()) + " frames in"));
}

TEST_F(ProgramTest, CtrlCLeavesAPlayableVideo) {
  const std::string output = folder_.file("out.jsonl");
  const std::string video = folder_.file("o.mp4");
  Program program(folder_.path(), {"run", pipeline_, "--output", output, "--video", video});
  wait_for_lines(output, 5);
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(text_of(video), HasSubstr("moov")) << "the index, written last: no player does "
                                                    "without it";
}

TEST_F(ProgramTest, ARunNeedsItsPipelineFileOnlyToBegin) {
  const std::string output = folder_.file("out.jsonl");
  Program program(folder_.path(), {"run", pipeline_, "--output", output});
  wait_for_lines(output, 5);
  std::filesystem::remove(pipeline_);
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("frames in"));
}

TEST_F(ProgramTest, AFullDiskIsReportedTheRunGoesOnAndTheExitCodeIsOne) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string good = folder_.file("good.jsonl");
  const std::string two_sinks = folder_.write(
      "two.yaml", std::string(kPipeline) + "sinks: [{jsonl: {path: '" + good + "'}}]\n");
  const auto result = maggic({"run", two_sinks, "--frames", "10", "--output", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("10 frames in"), HasSubstr("10 failed"),
                                HasSubstr("No space left on device")));
  EXPECT_EQ(lines_of(text_of(good)).size(), 10U) << "the other output is complete";
}

TEST_F(ProgramTest, AMissingOutputFolderIsReportedTheRunGoesOnAndTheExitCodeIsOne) {
  const std::string nowhere = folder_.file("nowhere");
  for (const auto& [flag, name] : {std::pair{"--output", "/o.jsonl"}, {"--video", "/o.mp4"}}) {
    const auto result = maggic({"run", pipeline_, "--frames", "3", flag, nowhere + name});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.out, AllOf(HasSubstr("3 frames in"),
                                  HasSubstr("folder " + nowhere + " does not exist")));
  }
  EXPECT_FALSE(std::filesystem::exists(nowhere));
}

TEST_F(ProgramTest, WritesAnAnnotatedVideo) {
  const std::string video = folder_.file("o.mp4");
  const auto result = maggic({"run", pipeline_, "--frames", "5", "--video", video});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(std::filesystem::file_size(video), 1000U);
}

TEST_F(ProgramTest, ARunThatNeverSawAFrameSaysSoAndGivesOne) {
  // A stream that nobody serves; it would be waited for as long as it takes.
  Program program(folder_.path(), {"run", pipeline_, "--source", "tcp://127.0.0.1:9"});
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const std::string err = folder_.file("stderr.txt");
  while (text_of(err).find("waiting for the first frame (") == std::string::npos &&
         std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("no frame ever came"));
  EXPECT_THAT(result.err, AllOf(HasSubstr("waiting for the first frame ("),
                                HasSubstr("note: no --calibration: corners and colours are those "
                                          "of " +
                                          pipeline_)));
}

TEST_F(ProgramTest, NeverWritesOverWhatItReads) {
  const std::string video = folder_.write("match.mp4", "precious");
  for (const char* flag : {"--output", "--video"}) {
    const auto result = maggic({"run", pipeline_, "--source", video, flag, video});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr(flag), HasSubstr(video), HasSubstr("--source")));
  }
  EXPECT_EQ(text_of(video), "precious");
}

TEST_F(ProgramTest, TwoOutputsIntoOneFileAreRefused) {
  const std::string output = folder_.file("out.mp4");
  const auto result = maggic({"run", pipeline_, "--output", output, "--video", output});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--output"), HasSubstr("--video"), HasSubstr(output)));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(ProgramTest, WrongUsageIsExplainedAndGivesTwo) {
  const struct {
    std::vector<std::string> arguments;
    const char* text;
  } cases[] = {
      {{"rnu", "x"}, "unknown command 'rnu'"},
      {{"run", "no_such_pipeline"}, "no_such_pipeline"},
      {{"run", pipeline_, "--set", "nonsense"}, "--set"},
      {{"run", pipeline_, "--calibration", "no_such_file"}, "no_such_file"},
      {{"describe", "no_such_plugin"}, "no_such_plugin"},
      {{"plugins", "--plugin-path", folder_.file("gone")}, "expected a folder that exists"},
      {{"new", "sink", "two_tag", folder_.file("x")}, "there is a plugin 'two_tag' already"},
      {{"new", "sinc", "x", folder_.file("x")}, "sinc"}};
  for (const auto& c : cases) {
    const auto result = maggic(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << c.text;
    EXPECT_THAT(result.err, HasSubstr(c.text));
  }
}

TEST_F(ProgramTest, NewTellsWhatItWroteAndWhatToDoNext) {
  const std::string folder = folder_.file("x");
  const auto result = maggic({"new", "sink", "warm_light", folder});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("wrote " + folder + "/warm_light: "), HasSubstr("warm_light.cpp"),
                    HasSubstr("cmake -S " + folder + "/warm_light -B "), HasSubstr("ctest"),
                    HasSubstr("maggic describe warm_light --plugin-path " + folder)));
}

TEST_F(ProgramTest, DescribesPluginsAndSections) {
  const auto plugin = maggic({"describe", "hue_pivots"});
  EXPECT_EQ(plugin.exit_code, 0) << plugin.err;
  EXPECT_THAT(plugin.out, AllOf(HasSubstr("segmenter hue_pivots"), HasSubstr("gray_threshold"),
                                HasSubstr("original|normalized")));
  EXPECT_THAT(maggic({"describe", "field"}).out, HasSubstr("half_time"));
  EXPECT_THAT(maggic({"describe"}).out, AllOf(HasSubstr("max_area_mm2"), HasSubstr("two_tag")));
}

TEST_F(ProgramTest, DescribesTheOtherPluginsWhenSomeFail) {
  const std::string extra = folder_.file("extra");
  std::filesystem::create_directory(extra);
  for (const char* name : {"throwing_constructor.so", "throwing_describe.so", "well_behaved.so"}) {
    std::filesystem::copy(std::filesystem::path(MAGGIC_TEST_PLUGIN_DIR) / name, extra);
  }
  const auto result = maggic({"describe", "--plugin-path", extra});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("'throwing_constructor'"), HasSubstr("the camera club"),
                                HasSubstr("'throwing_describe'"), HasSubstr("lost for words")));
  EXPECT_THAT(result.out, AllOf(HasSubstr("tracker two_tag"), HasSubstr("tracker well_behaved"),
                                HasSubstr("sink jsonl"), Not(HasSubstr("throwing_"))));
}

TEST_F(ProgramTest, ListsPluginsAndWhyAFileWasRefused) {
  std::filesystem::create_directory(folder_.file("extra"));
  folder_.write("extra/not_a_library.so", "hello");
  const auto result = maggic({"plugins", "--plugin-path", folder_.file("extra")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("hue_pivots"), HasSubstr("two_tag"), HasSubstr("not_a_library.so")));
}

/// A bad pipeline file and the places of the mistakes that are to be told.
struct BadFile {
  const char* name;
  std::string text;
  std::vector<std::string> expected;  ///< After the file's name.
};

void PrintTo(const BadFile& file, std::ostream* out) { *out << file.name; }

std::string billion_laughs() {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 0; k < 9; ++k) text += ", " + last;
    text += "]\n";
  }
  return text;
}

class BadPipelineFile : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadPipelineFile, IsAnsweredWithThePlaceOfEveryMistakeAndExitCodeTwo) {
  const BadFile& bad = GetParam();
  const Folder folder;
  const std::string file = folder.write("bad.yaml", bad.text);
  const ProgramResult result = Program(folder.path(), {"check", file}).wait();
  EXPECT_EQ(result.exit_code, 2) << result.err;
  for (const std::string& expected : bad.expected) {
    EXPECT_THAT(result.err, HasSubstr(file + expected));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, BadPipelineFile,
    ::testing::Values(
        BadFile{"UnknownSection", std::string(kPipeline) + "trakcer: two_tag\n", {":4:1: "}},
        BadFile{"UnknownKey",
                "source: synthetic_match\n"
                "segmenter:\n"
                "  hue_pivots:\n"
                "    gray_treshold: 30\n"
                "tracker: two_tag\n",
                {":4:5: "}},
        BadFile{"DuplicateKey", std::string(kPipeline) + "tracker: three_tag\n", {":4:1: "}},
        BadFile{"DuplicateParameter",
                "source: synthetic_match\n"
                "field: {half_time: true, half_time: false}\n"
                "tracker: two_tag\n",
                {":2:26: "}},
        BadFile{"OutOfRange",
                "source: synthetic_match\n"
                "segmenter: {hue_pivots: {gray_threshold: 300}}\n"
                "tracker: two_tag\n",
                {":2:42: "}},
        BadFile{"WrongType",
                "source: synthetic_match\n"
                "segmenter: {hue_pivots: {gray_threshold: many}}\n"
                "field: {half_time: 7}\n"
                "tracker: two_tag\n",
                {":2:42: ", ":3:20: "}},
        BadFile{"NumbersYamlReadsInItsOwnWay",
                "source: synthetic_match\n"
                "segmenter: {hue_pivots: {gray_threshold: 010}}\n"
                "field: {robot_height_mm: .nan, length_mm: .inf}\n"
                "tracker: two_tag\n",
                {":2:42: ", ":3:26: ", ":3:43: "}},
        BadFile{"MissingTracker", "source: synthetic_match\n", {""}},
        BadFile{"MissingParameter", std::string(kPipeline) + "sinks:\n  - jsonl: {}\n", {":5:"}},
        BadFile{"UnknownPlugin",
                "source: synthetic_match\nsegmenter: hue_pivot\ntracker: two_tag\n",
                {":2:12: "}},
        BadFile{"PluginOfAnotherKind",
                "source: synthetic_match\nsegmenter: two_tag\ntracker: two_tag\n",
                {":2:12: "}},
        BadFile{"SeveralMistakesAtOnce",
                "source: synthetic_match\n"
                "segmenter: {hue_pivots: {gray_threshold: -1}}\n"
                "field: {lengthmm: 3}\n"
                "tracker: no_such_tracker\n",
                {":2:42: ", ":3:9: ", ":4:10: "}},
        BadFile{"MalformedYaml", "source: synthetic_match\nfield: {length_mm: 3\n", {":"}},
        BadFile{"AListInsteadOfAMap", "- source\n- tracker\n", {":1:1: "}},
        BadFile{"AWordInsteadOfAMap", "hello\n", {":1:1: "}}, BadFile{"AnEmptyFile", "", {""}},
        BadFile{"ACycle", "source: &loop [*loop]\ntracker: two_tag\n", {":1:"}},
        BadFile{"BillionLaughs", billion_laughs(), {":"}},
        BadFile{"SeveralDocuments", std::string(kPipeline) + "---\n" + kPipeline, {":"}},
        BadFile{"Binary",
                std::string("\x7f"
                            "ELF\x02\x01\0\0\0\xff\xfe\0",
                            12),
                {":"}},
        BadFile{"DeepNesting", std::string(100'000, '['), {":1:"}}),
    [](const auto& test) { return test.param.name; });

TEST_F(ProgramTest, AFolderInsteadOfAPipelineFileIsNamed) {
  const std::string folder = folder_.file("folder");
  std::filesystem::create_directory(folder);
  for (const char* command : {"check", "run"}) {
    const auto result = maggic({command, folder});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(folder + ": "));
  }
}

TEST_F(ProgramTest, CheckGoesThroughAllFilesAndRunStartsNothingOnAMistake) {
  const std::string bad = folder_.write("bad.yaml", std::string(kPipeline) + "nonsense: 1\n");
  const std::string worse = folder_.write("worse.yaml", "nonsense: [");
  const auto checked = maggic({"check", bad, pipeline_, worse});
  EXPECT_EQ(checked.exit_code, 2);
  EXPECT_THAT(checked.err, AllOf(HasSubstr(bad + ":4:1: "), HasSubstr(worse + ":")));
  EXPECT_THAT(checked.out, HasSubstr(pipeline_ + ": ok"));

  const std::string output = folder_.file("out.jsonl");
  const auto run = maggic({"run", bad, "--frames", "3", "--output", output});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr(bad + ":4:1: "));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(ProgramTest, AMistakeInAnAssignmentIsToldAsSuch) {
  const auto result =
      maggic({"check", pipeline_, "--set", "segmenter.hue_pivots.gray_threshold=900"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--set"));
}

TEST_F(ProgramTest, AMissingVideoIsNamedAndNotFine) {
  const auto result = maggic({"run", pipeline_, "--source", folder_.file("no_such_video.mp4")});
  EXPECT_THAT(result.exit_code, AnyOf(1, 2));
  EXPECT_THAT(result.err + result.out, HasSubstr("no_such_video.mp4"));
}

}  // namespace
}  // namespace maggic
