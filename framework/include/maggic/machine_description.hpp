#pragma once
/// The machine that figures were measured on.

#include <cstddef>
#include <string>

namespace maggic {

struct MachineDescription {
  std::string cpu;     ///< The processor's own name; "unknown" where none is told.
  unsigned cores = 1;  ///< Threads that can run at once.
  std::size_t last_level_cache_bytes = 0;  ///< 0 when the system does not say.
};

MachineDescription describe_machine();

}  // namespace maggic
