#pragma once
/// From program arguments to option structs.

#include <span>
#include <string>
#include <variant>

#include "app/commands.hpp"

namespace maggic::app {

/// Nothing is to be run: help was asked for, or the arguments are wrong.
struct EarlyEnd {
  ExitCode code = kFine;
  std::string text;  ///< For standard output when `code` is kFine, else for standard error.
};

/// @param arguments without the program's name.
std::variant<CommandLine, EarlyEnd> parse_command_line(std::span<const char* const> arguments);

}  // namespace maggic::app
