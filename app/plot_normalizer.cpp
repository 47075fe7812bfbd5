#include <stdexcept>

#include "app/commands.hpp"

namespace maggic::app {

ExitCode plot_normalizer_command(const PlotNormalizerOptions&, const CommandLine&) { throw std::runtime_error("not yet"); }

}  // namespace maggic::app
