/// Refused: needs a function that nobody has.

#include "maggic/plugin.hpp"

int function_that_nobody_has();

namespace {

class MissingSymbol final : public maggic::Tracker {
 public:
  void track(const maggic::TrackerInput& /*input*/, maggic::Detections& out) override {
    out.sequence = static_cast<std::uint64_t>(function_that_nobody_has());
  }
};

}  // namespace

MAGGIC_PLUGIN(MissingSymbol, "cannot be linked")
