/// Broken on purpose: every mistake a `describe` function can make.

#include "maggic/plugin.hpp"

namespace {

class IllDescribedSink final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    p.integer({"Queue Length", "frames kept"}, length_, {1, 10});
    p.integer({"port", ""}, port_, {1, 65535});
    p.number({"rate", "packets a second"}, rate_, {0.0, 100.0});
    p.number({"rate", "the same key again"}, rate_, {0.0, 1000.0});
    p.check("rate", rate_ < 100.0, "is too much");
  }
  void open(const maggic::RunInfo& /*info*/) override {}
  void write(const maggic::FrameResult& /*result*/, const maggic::Field& /*field*/) override {}

 private:
  int length_ = 5;
  int port_ = 10006;
  double rate_ = 500.0;
};

}  // namespace

MAGGIC_PLUGIN(IllDescribedSink, "describes its parameters wrongly")
