#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode import_command(const ImportOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
