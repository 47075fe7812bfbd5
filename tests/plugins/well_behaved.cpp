/// Nothing is wrong with this one: what the broken ones are compared with.

#include "maggic/plugin.hpp"

namespace {

class WellBehaved final : public maggic::Tracker {
 public:
  void track(const maggic::TrackerInput& input, maggic::Detections& out) override {
    out.clear();
    out.sequence = input.sequence;
    out.captured = input.captured;
  }
};

}  // namespace

MAGGIC_PLUGIN(WellBehaved, "finds nothing, correctly")
