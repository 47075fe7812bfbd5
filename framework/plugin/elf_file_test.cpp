#include "plugin/elf_file.hpp"

#include <dlfcn.h>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include "maggic/stage.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A shared library that is certainly there and well: libmaggic itself.
fs::path real_library() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<void*>(static_cast<std::string_view (*)(StageKind)>(&name_of)), &info);
  return info.dli_fname;
}

fs::path scratch_folder() {
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("elf_file_test_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  static const struct Cleaner {
    fs::path folder;
    ~Cleaner() { fs::remove_all(folder); }
  } cleaner{folder};
  return folder;
}

/// A copy of the real library to be harmed.
fs::path copied_library() {
  const fs::path file = scratch_folder() / "copy.so";
  fs::copy_file(real_library(), file, fs::copy_options::overwrite_existing);
  return file;
}

fs::path file_with(const std::string& content) {
  const fs::path file = scratch_folder() / "made.so";
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

void overwrite(const fs::path& file, std::streamoff offset, const std::string& bytes) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekp(offset);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Why `file` is refused; empty when it is not.
std::string refusal(const fs::path& file) {
  try {
    ElfFile(file).exported_symbols();
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(ElfFile, ListsTheSymbolsALibraryExports) {
  EXPECT_THAT(ElfFile(real_library()).exported_symbols(),
              ::testing::Contains(HasSubstr("PluginRegistry")));
}

TEST(ElfFile, RefusesWhatIsNoRegularFile) {
  EXPECT_EQ(refusal(scratch_folder() / "nothing.so"), "no such file");
  EXPECT_EQ(refusal(scratch_folder()), "is a directory, expected a shared library");
  EXPECT_EQ(refusal("/dev/null"), "is no regular file, expected a shared library");
}

TEST(ElfFile, RefusesTextAndNothing) {
  EXPECT_EQ(refusal(file_with("#!/bin/sh\necho hello\n")),
            "is no ELF file, expected a shared library");
  EXPECT_EQ(refusal(file_with("")), "is empty, expected a shared library");
}

TEST(ElfFile, RefusesAnotherMachine) {
  const fs::path file = copied_library();
  overwrite(file, offsetof(ElfW(Ehdr), e_machine), std::string("\xF3\x7F", 2));
  EXPECT_THAT(refusal(file), AllOf(StartsWith("is built for another machine (ELF machine 32755"),
                                   HasSubstr("this program has ")));
}

TEST(ElfFile, RefusesAnotherWordSizeOrByteOrder) {
  fs::path file = copied_library();
  overwrite(file, EI_CLASS, std::string(1, sizeof(void*) == 8 ? ELFCLASS32 : ELFCLASS64));
  EXPECT_THAT(refusal(file), StartsWith("is built for another word size"));
  file = copied_library();
  overwrite(file, EI_DATA, "\x7F");
  EXPECT_THAT(refusal(file), StartsWith("is built for another byte order"));
}

TEST(ElfFile, RefusesAnObjectFileAndAProgram) {
  const fs::path file = copied_library();
  overwrite(file, offsetof(ElfW(Ehdr), e_type), std::string("\x01\x00", 2));
  EXPECT_EQ(refusal(file), "is an object file that was not linked, expected a shared library");
  overwrite(file, offsetof(ElfW(Ehdr), e_type), std::string("\x02\x00", 2));
  EXPECT_EQ(refusal(file), "is a program, expected a shared library");
}

TEST(ElfFile, RefusesEveryShortPrefix) {
  const fs::path file = copied_library();
  for (std::uintmax_t size = 200; size > 0; --size) {
    fs::resize_file(file, size);
    EXPECT_THAT(refusal(file), HasSubstr("cut short")) << size << " bytes";
  }
}

TEST(ElfFile, RefusesALibraryWithoutItsLastByte) {
  const fs::path file = copied_library();
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_THAT(refusal(file), StartsWith("is cut short or damaged"));
}

RC_GTEST_PROP(ElfFile, RefusesAnyPrefix, ()) {
  const fs::path file = copied_library();
  const auto size = *rc::gen::inRange<std::uintmax_t>(0, fs::file_size(file));
  fs::resize_file(file, size);
  RC_ASSERT(!refusal(file).empty());
}

RC_GTEST_PROP(ElfFile, SurvivesAnyDamage, ()) {
  const fs::path file = copied_library();
  const auto size = static_cast<std::streamoff>(fs::file_size(file));
  for (int hit = *rc::gen::inRange(1, 20); hit > 0; --hit) {
    // Most of a library is code, which is not looked at: aim at the headers at both ends.
    const auto near = *rc::gen::inRange<std::streamoff>(0, 4096);
    const bool at_the_end = *rc::gen::arbitrary<bool>();
    overwrite(file, at_the_end ? size - 1 - near : near,
              std::string(1, *rc::gen::arbitrary<char>()));
  }
  refusal(file);  // anything but a crash, a hang or another kind of exception
}

}  // namespace
}  // namespace maggic
