#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode sweep_command(const SweepOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
