#pragma once
/// Ctrl-C ends a run in order.

#include <atomic>

namespace maggic::app {

/// From now on the first Ctrl-C (or SIGTERM, or closing the terminal, unless it is to be outlived:
/// nohup) sets the flag that is returned, so that a run can end with its outputs complete; a second
/// one kills. The flag may also be set by the caller.
std::atomic<bool>& stop_on_signals();

}  // namespace maggic::app
