#include "app/command_line.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace maggic::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::variant<CommandLine, EarlyEnd> parse(std::vector<const char*> arguments) {
  return parse_command_line(arguments);
}

template <class T>
T command(std::vector<const char*> arguments) {
  const auto parsed = parse(std::move(arguments));
  if (const auto* end = std::get_if<EarlyEnd>(&parsed)) ADD_FAILURE() << end->text;
  return std::get<T>(std::get<CommandLine>(parsed).command);
}

TEST(CommandLine, ReadsEveryFlagOfRun) {
  const auto run = command<RunOptionsGiven>(
      {"run", "a.yaml", "--source", "0", "--calibration", "venue.yaml", "--set", "tracker.x=1",
       "--set", "field.half_time=true", "--frames", "10", "--duration", "2.5", "--output",
       "o.jsonl", "--video", "v.mp4", "--realtime"});
  EXPECT_EQ(run.pipeline.pipeline, "a.yaml");
  EXPECT_EQ(run.pipeline.source, "0");
  EXPECT_EQ(run.pipeline.calibration, "venue.yaml");
  EXPECT_THAT(run.pipeline.assignments, ElementsAre("tracker.x=1", "field.half_time=true"));
  EXPECT_EQ(run.frames, 10U);
  EXPECT_EQ(run.duration_s, 2.5);
  EXPECT_EQ(run.output, "o.jsonl");
  EXPECT_EQ(run.video, "v.mp4");
  EXPECT_TRUE(run.realtime);
}

TEST(CommandLine, TakesFlagsBeforeThePipeline) {
  const auto run = command<RunOptionsGiven>({"run", "--set", "a.b=1", "--frames", "3", "a.yaml"});
  EXPECT_EQ(run.pipeline.pipeline, "a.yaml");
  EXPECT_THAT(run.pipeline.assignments, ElementsAre("a.b=1"));
}

TEST(CommandLine, LeavesAbsentOptionsEmpty) {
  const auto run = command<RunOptionsGiven>({"run", "a.yaml"});
  EXPECT_FALSE(run.pipeline.source);
  EXPECT_FALSE(run.frames);
  EXPECT_FALSE(run.output);
  EXPECT_FALSE(run.realtime);
}

TEST(CommandLine, TakesWhereTheStudioIsServed) {
  const auto usual = command<StudioOptions>({"studio", "a.yaml", "--source", "0"});
  EXPECT_EQ(usual.pipeline.source, "0");
  EXPECT_EQ(usual.listen, "127.0.0.1");
  EXPECT_EQ(usual.port, 8642);
  const auto other =
      command<StudioOptions>({"studio", "a.yaml", "--port", "0", "--listen", "0.0.0.0"});
  EXPECT_EQ(other.listen, "0.0.0.0");
  EXPECT_EQ(other.port, 0);
}

TEST(CommandLine, TakesPluginFoldersBeforeAndAfterTheCommand) {
  for (const auto& arguments :
       {std::vector<const char*>{"--plugin-path", "a", "--plugin-path", "b", "plugins"},
        std::vector<const char*>{"plugins", "--plugin-path", "a", "--plugin-path", "b"}}) {
    const auto parsed = parse(arguments);
    ASSERT_TRUE(std::holds_alternative<CommandLine>(parsed));
    EXPECT_THAT(std::get<CommandLine>(parsed).plugin_folders, ElementsAre("a", "b"));
  }
}

TEST(CommandLine, BenchNeedsNoPipeline) {
  const auto bare = command<BenchOptions>({"bench"});
  EXPECT_EQ(bare.pipeline.pipeline, "maggic_3v3");
  EXPECT_EQ(bare.frames, 300U);
  EXPECT_FALSE(bare.threads);
  const auto full = command<BenchOptions>(
      {"bench", "a.yaml", "--source", "0", "--frames", "50", "--threads", "4", "--json", "b.json"});
  EXPECT_EQ(full.pipeline.pipeline, "a.yaml");
  EXPECT_EQ(full.pipeline.source, "0");
  EXPECT_EQ(full.frames, 50U);
  EXPECT_EQ(full.threads, 4U);
  EXPECT_EQ(full.json, "b.json");
}

TEST(CommandLine, ReadsTheOtherCommands) {
  EXPECT_THAT(command<CheckOptions>({"check", "a", "b"}).pipelines, ElementsAre("a", "b"));
  EXPECT_THAT(command<DescribeOptions>({"describe"}).names, ElementsAre());
  EXPECT_THAT(command<DescribeOptions>({"describe", "field"}).names, ElementsAre("field"));
  const auto created = command<NewOptions>({"new", "sink", "my_sink", "/tmp/x"});
  EXPECT_EQ(created.kind, "sink");
  EXPECT_EQ(created.name, "my_sink");
  EXPECT_EQ(created.folder, "/tmp/x");
}

TEST(CommandLine, HelpIsNoMistake) {
  for (const auto& arguments : {std::vector<const char*>{"--help"}, {"run", "--help"}}) {
    const auto parsed = parse(arguments);
    const auto& end = std::get<EarlyEnd>(parsed);
    EXPECT_EQ(end.code, kFine);
    EXPECT_THAT(end.text, HasSubstr("run"));
  }
}

TEST(CommandLine, AMistypedCommandIsAnsweredWithTheKnownOnes) {
  const auto parsed = parse({"--plugin-path", "x", "rnu", "a.yaml"});
  const auto& end = std::get<EarlyEnd>(parsed);
  EXPECT_EQ(end.code, kMistake);
  EXPECT_THAT(
      end.text,
      HasSubstr("unknown command 'rnu', did you mean 'run'? "
                "(known: run, studio, calibrate, score, compare, bench, sweep, plot, import, "
                "check, plugins, describe, new)"));
}

std::string mistake_text(std::vector<const char*> arguments) {
  const auto parsed = parse(std::move(arguments));
  if (!std::holds_alternative<EarlyEnd>(parsed)) return "no mistake";
  EXPECT_EQ(std::get<EarlyEnd>(parsed).code, kMistake);
  const std::string& text = std::get<EarlyEnd>(parsed).text;
  return text.substr(0, text.find('\n'));
}

TEST(CommandLine, SuggestsTheNearestOptionAndCommand) {
  EXPECT_EQ(mistake_text({"run", "a", "--frame", "3"}),
            "unknown option '--frame', did you mean '--frames'?");
  EXPECT_EQ(mistake_text({"run", "--sorce=0"}),
            "unknown option '--sorce', did you mean '--source'?");
  EXPECT_EQ(mistake_text({"--plugn-path", "x", "plugins"}),
            "unknown option '--plugn-path', did you mean '--plugin-path'?");
  EXPECT_EQ(mistake_text({"run", "a", "-x"}), "unknown option '-x'");
  EXPECT_EQ(mistake_text({"run", "a", "--colour-table"}), "unknown option '--colour-table'");
  EXPECT_THAT(mistake_text({"chekc", "a"}), HasSubstr("'chekc', did you mean 'check'?"));
  EXPECT_THAT(mistake_text({"benchmark"}), HasSubstr("unknown command 'benchmark' (known:"));
}

TEST(CommandLine, SaysWhichNumbersEndARun) {
  for (const std::string found :
       {"abc", "-5", "0", "3.5", "5x", "", "0x10", "99999999999999999999"}) {
    EXPECT_EQ(mistake_text({"run", "a", "--frames", found.c_str()}),
              "--frames: found '" + found + "', expected a whole number above 0");
  }
  for (const std::string found : {"x", "-1", "0", "inf", "nan", "1e999"}) {
    EXPECT_EQ(mistake_text({"run", "a", "--duration", found.c_str()}),
              "--duration: found '" + found + "', expected a number of seconds above 0");
  }
  EXPECT_EQ(command<RunOptionsGiven>({"run", "a", "--frames", "010"}).frames, 10U);
  EXPECT_EQ(command<RunOptionsGiven>({"run", "a", "--duration", "1e-3"}).duration_s, 0.001);
}

TEST(CommandLine, NamesWhatIsMissingOrWrong) {
  const struct {
    std::vector<const char*> arguments;
    const char* text;
  } cases[] = {{{}, "subcommand"},
               {{"run"}, "pipeline is required"},
               {{"run", "a", "--frames", "0"}, "--frames"},
               {{"run", "a", "--frames", "-3"}, "--frames"},
               {{"run", "a", "--frames", "many"}, "--frames"},
               {{"run", "a", "--duration", "0"}, "--duration"},
               {{"run", "a", "--output"}, "--output"},
               {{"run", "a", "--fast"}, "--fast"},
               {{"run", "a", "b"}, "b"},
               {{"new", "sink", "x"}, "folder is required"}};
  for (const auto& c : cases) {
    const auto parsed = parse(c.arguments);
    ASSERT_TRUE(std::holds_alternative<EarlyEnd>(parsed)) << c.text;
    EXPECT_EQ(std::get<EarlyEnd>(parsed).code, kMistake);
    EXPECT_THAT(std::get<EarlyEnd>(parsed).text, HasSubstr(c.text));
  }
}

}  // namespace
}  // namespace maggic::app
