#include "plugin/elf_file.hpp"

#include <dlfcn.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace maggic {
namespace {

[[noreturn]] void refuse(std::string reason) { throw std::runtime_error(std::move(reason)); }

/// The running program's own header, as mapped by the loader: what machine "this one" is.
const ElfW(Ehdr) & own_header() {
  static const ElfW(Ehdr)* const header = [] {
    static const char anchor = 0;
    Dl_info info{};
    ::dladdr(&anchor, &info);
    return static_cast<const ElfW(Ehdr)*>(info.dli_fbase);
  }();
  return *header;
}

std::uint64_t size_of_regular_file(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) refuse("no such file");
  if (status.type() == fs::file_type::directory)
    refuse("is a directory, expected a shared library");
  if (status.type() == fs::file_type::none) refuse("cannot be looked at: " + error.message());
  if (!fs::is_regular_file(status)) refuse("is no regular file, expected a shared library");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) refuse("cannot be looked at: " + error.message());
  return size;
}

std::string_view type_name(unsigned type) {
  switch (type) {
    case ET_REL: return "an object file that was not linked";
    case ET_EXEC: return "a program";
    case ET_CORE: return "a core dump";
    default: return "an ELF file of an unknown type";
  }
}

}  // namespace

ElfFile::ElfFile(const std::filesystem::path& file)
    : file_size_(size_of_regular_file(file)), stream_(file, std::ios::binary) {
  if (!stream_) refuse("cannot be opened for reading");
  const std::size_t available = std::min<std::uint64_t>(file_size_, sizeof(header_));
  if (!stream_.read(reinterpret_cast<char*>(&header_), static_cast<std::streamsize>(available))) {
    refuse("cannot be read");
  }
  check_header();

  // The tables themselves are bounded by the file before memory is asked for.
  expect_inside("program headers", header_.e_phoff, header_.e_phnum * sizeof(Segment));
  expect_inside("section headers", header_.e_shoff, header_.e_shnum * sizeof(Section));
  segments_.resize(header_.e_phnum);
  sections_.resize(header_.e_shnum);
  read_array(header_.e_phoff, segments_);
  read_array(header_.e_shoff, sections_);
  check_extents();
}

void ElfFile::check_header() const {
  const auto& ident = header_.e_ident;
  if (file_size_ == 0) refuse("is empty, expected a shared library");
  const auto magic_length = std::min<std::uint64_t>(file_size_, SELFMAG);
  if (std::memcmp(ident, ELFMAG, magic_length) != 0)
    refuse("is no ELF file, expected a shared library");
  if (file_size_ < sizeof(header_)) {
    refuse(fmt::format("is cut short: {} bytes, expected a header of {}", file_size_,
                       sizeof(header_)));
  }
  const ElfW(Ehdr)& own = own_header();
  if (ident[EI_CLASS] != own.e_ident[EI_CLASS]) {
    refuse(fmt::format("is built for another word size (ELF class {}, this program has {})",
                       ident[EI_CLASS], own.e_ident[EI_CLASS]));
  }
  if (ident[EI_DATA] != own.e_ident[EI_DATA]) {
    refuse(fmt::format("is built for another byte order (ELF data {}, this program has {})",
                       ident[EI_DATA], own.e_ident[EI_DATA]));
  }
  if (header_.e_machine != own.e_machine) {
    refuse(fmt::format("is built for another machine (ELF machine {}, this program has {})",
                       header_.e_machine, own.e_machine));
  }
  if (header_.e_type != ET_DYN) {
    refuse(fmt::format("is {}, expected a shared library", type_name(header_.e_type)));
  }
  if (header_.e_phnum == 0 || header_.e_phentsize != sizeof(Segment)) {
    refuse("has no usable program headers");
  }
  if (header_.e_shnum == 0 || header_.e_shentsize != sizeof(Section)) {
    refuse("has no usable section headers");
  }
}

void ElfFile::check_extents() const {
  for (const Segment& segment : segments_) {
    expect_inside("a segment", segment.p_offset, segment.p_filesz);
  }
  for (const Section& section : sections_) {
    if (section.sh_type == SHT_NOBITS || section.sh_type == SHT_NULL) continue;
    expect_inside("a section", section.sh_offset, section.sh_size);
  }
}

void ElfFile::expect_inside(std::string_view what, std::uint64_t offset, std::uint64_t size) const {
  if (size <= file_size_ && offset <= file_size_ - size) return;
  refuse(fmt::format("is cut short or damaged: {} of {} bytes at {}, in a file of {} bytes", what,
                     size, offset, file_size_));
}

template <class T>
void ElfFile::read_array(std::uint64_t offset, std::vector<T>& into) {
  stream_.seekg(static_cast<std::streamoff>(offset));
  if (!stream_.read(reinterpret_cast<char*>(into.data()),
                    static_cast<std::streamsize>(into.size() * sizeof(T)))) {
    refuse("cannot be read");
  }
}

std::vector<std::string> ElfFile::exported_symbols() {
  const auto table = std::ranges::find(sections_, SHT_DYNSYM, &Section::sh_type);
  if (table == sections_.end()) return {};
  if (table->sh_link >= sections_.size() || sections_[table->sh_link].sh_type != SHT_STRTAB) {
    refuse("has a damaged symbol table: its names are missing");
  }
  const Section& text = sections_[table->sh_link];
  std::vector<ElfW(Sym)> symbols(table->sh_size / sizeof(ElfW(Sym)));
  std::vector<char> names(text.sh_size);
  read_array(table->sh_offset, symbols);
  read_array(text.sh_offset, names);
  names.push_back('\0');  // a damaged table need not end in one

  std::vector<std::string> exported;
  for (const ElfW(Sym) & symbol : symbols) {
    const unsigned binding = symbol.st_info >> 4;
    if (binding == STB_LOCAL || symbol.st_shndx == SHN_UNDEF) continue;
    if (symbol.st_name >= names.size()) refuse("has a damaged symbol table: a name is outside");
    exported.emplace_back(names.data() + symbol.st_name);
  }
  return exported;
}

}  // namespace maggic
