/// Broken on purpose: expects something in every frame, and cannot be closed unused.

#include <stdexcept>

#include "maggic/plugin.hpp"

namespace {

class DemandingSink final : public maggic::Sink {
 public:
  void open(const maggic::RunInfo& /*info*/) override {}
  void write(const maggic::FrameResult& result, const maggic::Field& /*field*/) override {
    if (result.detections.robots.empty()) throw std::runtime_error("no robots");
    written_ = true;
  }
  void close() override {
    if (!written_) throw std::runtime_error("nothing was written");
  }

 private:
  bool written_ = false;
};

}  // namespace

MAGGIC_PLUGIN(DemandingSink, "fails on a frame in which nothing was found")
