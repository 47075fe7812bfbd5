#pragma once
/// One value as YAML on one line.

#include <string>

#include "maggic/document.hpp"

namespace maggic {

/// Flow style: `{name: one, size: [1, 2]}`.
std::string to_flow_yaml(const Node& node);

}  // namespace maggic
