#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode score_command(const ScoreOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
