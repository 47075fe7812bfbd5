#pragma once
/// Something that happened in a session and is told to whoever listens.

#include <cstdint>
#include <string>

namespace maggic::studio {

struct Event {
  std::uint64_t number = 0;  ///< Counts up from 1 over all names.
  std::string name;          ///< `frame`, `settings` or `message`.
  std::string data;          ///< JSON.
};

}  // namespace maggic::studio
