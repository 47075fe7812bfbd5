#pragma once
/// JSON text to a tree, with the place of what is wrong in it.

#include <string_view>

#include <nlohmann/json.hpp>

namespace maggic {

/// @param file_name as shown in messages.
/// @throws ConfigError at line and column of the first mistake: what is no JSON, numbers too large
///   for a double, keys that occur twice in one object (by their path).
nlohmann::json parse_json(std::string_view text, std::string_view file_name);

}  // namespace maggic
