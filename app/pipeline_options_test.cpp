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

}  // namespace
}  // namespace maggic::app
