#pragma once
/// Configuration as JSON, and back.

#include <string_view>

#include <nlohmann/json.hpp>

#include "maggic/document.hpp"

namespace maggic::studio {

/// A scalar that is not quoted and reads as a number, true or false becomes one; any other a text.
nlohmann::json to_json(const Node& node);

/// @param file_name as mistakes in it are to name their place. @throws ConfigError beyond the
/// limits
///   of documents.
Node to_node(const nlohmann::json& json, std::string_view file_name);

}  // namespace maggic::studio
