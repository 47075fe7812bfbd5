#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode compare_command(const CompareOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
