/// Whatever bytes a plugin file holds, looking at it ends in symbols or in a sentence.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "plugin/elf_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("elf_file_fuzz", 0);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  try {
    maggic::ElfFile("/proc/self/fd/" + std::to_string(file)).exported_symbols();
  } catch (const std::runtime_error& refused) {
    if (std::string(refused.what()).empty()) std::abort();
  }
  close(file);
  return 0;
}
