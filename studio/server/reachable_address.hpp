#pragma once
/// What to type to reach a server.

#include <string>

namespace maggic::studio {

/// `listen_address` itself, or for one that stands for all of this machine's (`0.0.0.0`, `::`) one
/// of those that other machines reach; the loopback address where it has none.
std::string reachable_address(const std::string& listen_address);

}  // namespace maggic::studio
