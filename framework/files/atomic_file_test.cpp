#include "maggic/atomic_file.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

namespace maggic {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  std::size_t files_left() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("maggic_atomic_file_" + std::to_string(::getpid()));
};

TEST_F(AtomicFile, ReplacesWhatWasThereAndLeavesNothingBeside) {
  write_file_atomically(folder_ / "a.yaml", "old");
  write_file_atomically(folder_ / "a.yaml", "new");
  EXPECT_EQ(text_of(folder_ / "a.yaml"), "new");
  EXPECT_EQ(files_left(), 1u);
}

TEST_F(AtomicFile, KeepsTheModeOfTheFileItReplaces) {
  write_file_atomically(folder_ / "a.yaml", "old");
  fs::permissions(folder_ / "a.yaml", fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(folder_ / "a.yaml", "new");
  EXPECT_EQ(fs::status(folder_ / "a.yaml").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFile, FollowsALink) {
  write_file_atomically(folder_ / "real.yaml", "old");
  fs::create_symlink("real.yaml", folder_ / "link.yaml");
  write_file_atomically(folder_ / "link.yaml", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.yaml"));
  EXPECT_EQ(text_of(folder_ / "real.yaml"), "new");
}

TEST_F(AtomicFile, KeepsTheOldFileWhenTheNewOneCannotBeWrittenWhole) {
  const fs::path file = folder_ / "a.yaml";
  write_file_atomically(file, "old");
  // In a process of its own: the limit on the size of files cannot be lifted again.
  const auto write_beyond_the_limit = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    limit.rlim_cur = limit.rlim_max = 100;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file_atomically(file, std::string(10'000, 'x'));
    } catch (const std::runtime_error&) {
      std::_Exit(7);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(write_beyond_the_limit(), ::testing::ExitedWithCode(7), "");
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(files_left(), 1u);
}

TEST_F(AtomicFile, SaysWhichFileCannotBeWrittenAndWhy) {
  const fs::path nowhere = folder_ / "missing" / "a.yaml";
  try {
    write_file_atomically(nowhere, "new");
    FAIL() << "expected an exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr(nowhere.string()),
                                               ::testing::HasSubstr("No such file")));
  }
  EXPECT_THROW(write_file_atomically(folder_, "new"), std::runtime_error);
}

}  // namespace
}  // namespace maggic
