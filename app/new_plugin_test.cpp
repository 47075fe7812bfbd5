#include "app/new_plugin.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

namespace maggic::app {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

class NewPlugin : public ::testing::TestWithParam<StageKind> {
 protected:
  NewPlugin() { fs::create_directories(folder_); }
  ~NewPlugin() override { fs::remove_all(folder_); }

  static std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  std::string refusal_of_name(std::string_view name) const {
    try {
      new_plugin(StageKind::kSink, name, folder_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / fmt::format("new_plugin_{}", ::getpid());
};

TEST_P(NewPlugin, IsAFolderWithItsFourFilesFilledIn) {
  new_plugin(GetParam(), "warm_light2", folder_);
  const fs::path plugin = folder_ / "warm_light2";
  EXPECT_THAT(names_in(folder_), UnorderedElementsAre("warm_light2"));
  EXPECT_THAT(names_in(plugin), UnorderedElementsAre("warm_light2.cpp", "warm_light2_test.cpp",
                                                     "CMakeLists.txt", "README.md"));
  for (const std::string& name : names_in(plugin)) {
    EXPECT_THAT(text_of(plugin / name), AllOf(HasSubstr("warm_light2"), Not(HasSubstr("@")),
                                              Not(::testing::StartsWith("\n"))))
        << name;
  }
  EXPECT_THAT(text_of(plugin / "warm_light2.cpp"), HasSubstr("\nMAGGIC_PLUGIN(WarmLight2, \""));
}

INSTANTIATE_TEST_SUITE_P(EveryKind, NewPlugin,
                         ::testing::Values(StageKind::kSource, StageKind::kNormalizer,
                                           StageKind::kSegmenter, StageKind::kTracker,
                                           StageKind::kSink),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

TEST_F(NewPlugin, RefusesWhatIsNoName) {
  for (const char* name : {"", "Warm", "2warm", "_warm", "warm_", "warm__light", "warm light",
                           "warm-light", "../warm", "wärm"}) {
    EXPECT_THAT(refusal_of_name(name), HasSubstr("expected lower-case words joined by _")) << name;
  }
  EXPECT_THAT(refusal_of_name("test"), HasSubstr("the build uses it already"));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(NewPlugin, RefusesAnUnknownKind) {
  EXPECT_THROW(new_plugin(static_cast<StageKind>(7), "warm", folder_), std::invalid_argument);
}

TEST_F(NewPlugin, LeavesAnExistingFolderAsItIs) {
  fs::create_directories(folder_ / "warm");
  EXPECT_THAT([&] { new_plugin(StageKind::kSink, "warm", folder_); },
              ThrowsMessage<std::runtime_error>((folder_ / "warm").string() + " exists already"));
  EXPECT_TRUE(fs::is_empty(folder_ / "warm"));
}

TEST_F(NewPlugin, LeavesNothingWhereItCannotWrite) {
  std::ofstream(folder_ / "a_file") << "in the way";
  EXPECT_THROW(new_plugin(StageKind::kSink, "warm", folder_ / "a_file"), std::runtime_error);
  EXPECT_THAT(names_in(folder_), UnorderedElementsAre("a_file"));
}

TEST_F(NewPlugin, MakesTheFolderItIsPutInto) {
  new_plugin(StageKind::kSink, "warm", folder_ / "ours/sinks");
  EXPECT_TRUE(fs::exists(folder_ / "ours/sinks/warm/warm.cpp"));
}

}  // namespace
}  // namespace maggic::app
