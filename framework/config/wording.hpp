#pragma once
/// How messages about configuration are worded.

#include <span>
#include <string>
#include <string_view>

#include "maggic/document.hpp"

namespace maggic {

/// `text` in single quotes, control characters escaped and long text cut, fit for a terminal.
std::string quoted_excerpt(std::string_view text);

/// What stands at a node, as in "found …": "nothing", "'text'", "a list", "a map".
std::string description_of(const Node& node);

/// The name a person most likely meant; empty when none is near.
std::string_view nearest_name(std::string_view name, std::span<const std::string> known);

/// "unknown <what> 'nmae', did you mean 'name'? (known: name, other)".
std::string unknown_name_message(std::string_view what, std::string_view name,
                                 std::span<const std::string> known);

/// A mistake at a node's place.
Mistake mistake_at(const Place& place, std::string message);

}  // namespace maggic
