#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode calibrate_command(const CalibrateOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
