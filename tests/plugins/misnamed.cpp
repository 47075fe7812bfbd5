/// Refused: was compiled under another name than its file's.

#undef MAGGIC_PLUGIN_NAME
#define MAGGIC_PLUGIN_NAME "another_name"
#include "maggic/plugin.hpp"

namespace {

class Misnamed final : public maggic::Tracker {
 public:
  void track(const maggic::TrackerInput& /*input*/, maggic::Detections& /*out*/) override {}
};

}  // namespace

MAGGIC_PLUGIN(Misnamed, "calls itself otherwise than its file")
