#include "maggic/atomic_folder.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>

namespace maggic {
namespace {

namespace fs = std::filesystem;

class AtomicFolderTest : public ::testing::Test {
 protected:
  AtomicFolderTest() {
    std::string name = fs::temp_directory_path() / "atomic_folder_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    root_ = name;
  }
  ~AtomicFolderTest() override { fs::remove_all(root_); }

  static bool is_ours(std::string_view name) { return name == "report"; }
  static void write(const fs::path& file, std::string_view text) { std::ofstream(file) << text; }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(root_), fs::directory_iterator()));
  }

  fs::path root_;
};

TEST_F(AtomicFolderTest, AppearsOnlyOnceItIsComplete) {
  const fs::path target = root_ / "out";
  {
    AtomicFolder folder(target, is_ours);
    write(folder.path() / "report", "new");
    EXPECT_FALSE(fs::exists(target));
    folder.commit();
  }
  EXPECT_EQ(read(target / "report"), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFolderTest, LeavesNothingWhenItNeverWasComplete) {
  {
    AtomicFolder folder(root_ / "out", is_ours);
    write(folder.path() / "report", "half");
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(AtomicFolderTest, ReplacesAnEarlierOneAsAWhole) {
  const fs::path target = root_ / "out/";
  for (const char* text : {"old", "new"}) {
    AtomicFolder folder(target, is_ours);
    write(folder.path() / "report", text);
    folder.commit();
  }
  EXPECT_EQ(read(target / "report"), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFolderTest, NeverReplacesWhatIsNotItsOwn) {
  const fs::path target = root_ / "thesis";
  fs::create_directory(target);
  write(target / "chapter_1", "precious");
  EXPECT_THROW(AtomicFolder(target, is_ours), std::runtime_error);
  EXPECT_EQ(read(target / "chapter_1"), "precious");
  write(root_ / "file", "precious");
  EXPECT_THROW(AtomicFolder(root_ / "file", is_ours), std::runtime_error);
  EXPECT_THROW(AtomicFolder(root_ / "gone" / "out", is_ours), std::runtime_error);
  EXPECT_EQ(entries(), 2u);
}

}  // namespace
}  // namespace maggic
