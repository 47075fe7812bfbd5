#pragma once
/// What each sub-command accepts.

#include <functional>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/commands.hpp"

namespace maggic::app {

/// A sub-command the parser knows, and what it stands for once it was given.
struct OfferedCommand {
  CLI::App* app;                    ///< Owned by the parser.
  std::function<Command()> chosen;  ///< Valid after parsing, when `app->parsed()`.
};

/// Adds every sub-command to `app`. The answer keeps the options, so it has to live until parsing
/// is over.
std::vector<OfferedCommand> offer_commands(CLI::App& app);

}  // namespace maggic::app
