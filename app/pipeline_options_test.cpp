#include "app/pipeline_options.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace maggic::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class FindConfiguration : public ::testing::Test {
 protected:
  FindConfiguration() {
    for (const char* folder : {"first", "second"}) {
      std::filesystem::create_directories(root_ / folder);
    }
    std::ofstream(root_ / "first" / "fast.yaml") << "{}";
    std::ofstream(root_ / "second" / "fast.yaml") << "{}";
    std::ofstream(root_ / "second" / "slow.yaml") << "{}";
  }
  ~FindConfiguration() override { std::filesystem::remove_all(root_); }

  const std::filesystem::path root_ = std::filesystem::path(::testing::TempDir()) /
                                      ("find_configuration_" + std::to_string(::getpid()));
  const std::vector<std::filesystem::path> folders_{root_ / "first", root_ / "second"};
};

TEST_F(FindConfiguration, TakesAFileAsItIs) {
  const std::string file = root_ / "second" / "slow.yaml";
  EXPECT_EQ(find_configuration(file, folders_), file);
}

TEST_F(FindConfiguration, FindsNamesWithAndWithoutExtensionInTheFirstFolderThatHasThem) {
  EXPECT_EQ(find_configuration("fast", folders_), root_ / "first" / "fast.yaml");
  EXPECT_EQ(find_configuration("slow", folders_), root_ / "second" / "slow.yaml");
  EXPECT_EQ(find_configuration("slow.yaml", folders_), root_ / "second" / "slow.yaml");
}

TEST_F(FindConfiguration, LeavesAFolderToTheReaderWhichSaysWhatIsWrong) {
  EXPECT_EQ(find_configuration(root_.string(), folders_), root_);
}

TEST_F(FindConfiguration, ListsTheKnownNamesWhenThereIsNoSuchFile) {
  EXPECT_THAT([&] { find_configuration("fats", folders_); },
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("fats"), HasSubstr("fast, slow"))));
}

TEST(SinkNode, IsOneSinkWithItsPathAsText) {
  const Node node = sink_node("jsonl", "12", "--output");
  const Node* path = node.find("jsonl")->find("path");
  ASSERT_NE(path, nullptr);
  EXPECT_EQ(path->scalar, "12");
  EXPECT_TRUE(path->quoted);
  EXPECT_EQ(path->place.file, "--output");
}

class CheckOutputs : public FindConfiguration {
 protected:
  /// A pipeline that reads `source` and writes `sinks`.
  static void check(const std::string& source, const std::vector<std::string>& sinks) {
    std::string text = "source: {video: {path: '" + source + "'}}\nsinks:\n";
    for (const std::string& sink : sinks) text += "  - jsonl: {path: '" + sink + "'}\n";
    check_outputs(parse_document(text, "p.yaml"));
  }

  const std::string video_ = root_ / "second" / "slow.yaml";
};

TEST_F(CheckOutputs, RefusesToWriteOverWhatTheSourceReadsByAnyName) {
  const std::string detour = root_ / "first" / ".." / "second" / "slow.yaml";
  const std::string soft = root_ / "soft";
  const std::string hard = root_ / "hard";
  std::filesystem::create_symlink(video_, soft);
  std::filesystem::create_hard_link(video_, hard);
  for (const std::string& name : {video_, detour, soft, hard}) {
    EXPECT_THAT([&] { check(video_, {name}); },
                ThrowsMessage<ConfigError>(AllOf(HasSubstr("p.yaml:3:"), HasSubstr(name),
                                                 HasSubstr(video_), HasSubstr("destroy"))));
    EXPECT_THROW(check("file://" + video_, {name}), ConfigError);
  }
}

TEST_F(CheckOutputs, RefusesToWriteOverTheConfiguration) {
  const Node document = parse_document("sinks: [{jsonl: {path: '" + video_ + "'}}]", "p.yaml");
  EXPECT_NO_THROW(check_outputs(document, {root_ / "other.yaml"}));
  EXPECT_THAT(
      [&] {
        check_outputs(document, {root_ / "other.yaml", video_});
      },
      ThrowsMessage<ConfigError>(AllOf(HasSubstr(video_), HasSubstr("configured by"))));
}

TEST_F(CheckOutputs, RefusesTwoSinksWithOneOutput) {
  const std::string fresh = root_ / "fresh.jsonl";
  const std::string same = root_ / "first" / ".." / "fresh.jsonl";
  EXPECT_THAT(
      [&] {
        check(video_, {fresh, same});
      },
      ThrowsMessage<ConfigError>(AllOf(HasSubstr("p.yaml:4:"), HasSubstr(same), HasSubstr(fresh),
                                       HasSubstr("p.yaml:3:"))));
  EXPECT_THROW(check(video_, {"no_such_file", "./no_such_file"}), ConfigError);
  EXPECT_THROW(check(video_, {"-", "-"}), ConfigError);
}

TEST_F(CheckOutputs, LeavesOtherFilesAlone) {
  EXPECT_NO_THROW(check(video_, {root_ / "a", root_ / "b", "-", "./-"}));
  EXPECT_NO_THROW(check("rtsp://camera/live", {video_}));
  EXPECT_NO_THROW(check(root_ / "second", {root_ / "second" / "out.jsonl"}));
}

}  // namespace
}  // namespace maggic::app
