#pragma once
/// What can be known about a shared library without running a line of it.

#include <elf.h>
#include <link.h>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace maggic {

/// A shared library's file, checked as far as the loader trusts it blindly: `dlopen` maps what the
/// headers promise, and a file that ends before that kills the process with SIGBUS.
///
/// Used instead of `boost::dll::library_info`, which up to Boost 1.74 reads `.symtab` alone, so it
/// finds nothing in a stripped library, and looks names up in the file's last string table, which
/// today's linkers use for section names.
class ElfFile {
 public:
  /// @throws std::runtime_error with what was found and what was expected, the file's name left
  ///   out: not a regular file, not ELF, of another word size, byte order or machine than the
  ///   running program, not a shared object, or shorter than its headers promise.
  explicit ElfFile(const std::filesystem::path& file);

  /// Names that `dlsym` would find: defined, global or weak, in the dynamic symbol table.
  /// @throws std::runtime_error when that table is malformed.
  std::vector<std::string> exported_symbols();

 private:
  using Header = ElfW(Ehdr);
  using Segment = ElfW(Phdr);
  using Section = ElfW(Shdr);

  void check_header() const;
  void check_extents() const;
  template <class T>
  void read_array(std::uint64_t offset, std::vector<T>& into);
  void expect_inside(std::string_view what, std::uint64_t offset, std::uint64_t size) const;

  std::uint64_t file_size_ = 0;
  std::ifstream stream_;
  Header header_{};
  std::vector<Segment> segments_;
  std::vector<Section> sections_;
};

}  // namespace maggic
