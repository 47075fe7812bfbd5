/// Loads, but cannot be created: throws a type of its own, whose code lies in this library.

#include <stdexcept>

#include "maggic/plugin.hpp"

namespace {

class OwnError final : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ThrowingConstructor final : public maggic::Tracker {
 public:
  ThrowingConstructor() { throw OwnError("the camera club has the key"); }
  void track(const maggic::TrackerInput& /*input*/, maggic::Detections& /*out*/) override {}
};

}  // namespace

MAGGIC_PLUGIN(ThrowingConstructor, "throws when it is made")
