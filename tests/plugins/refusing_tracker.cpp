/// Broken on purpose: warns, and then refuses to be prepared with an exception of its own type.

#include <stdexcept>

#include "maggic/plugin.hpp"

namespace {

class OwnError final : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RefusingTracker final : public maggic::Tracker {
 public:
  void describe(maggic::Parameters& p) override {
    p.boolean({"refuse", "whether it refuses"}, refuse_);
  }
  void prepare(const maggic::StageContext& context) override {
    context.reporter.warn("the grass is wet");
    if (refuse_) throw OwnError("nobody plays in the rain");
  }
  void track(const maggic::TrackerInput& /*input*/, maggic::Detections& out) override {
    out.clear();
  }

 private:
  bool refuse_ = true;
};

}  // namespace

MAGGIC_PLUGIN(RefusingTracker, "refuses to be prepared")
