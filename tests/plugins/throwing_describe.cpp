/// Can be created, but not asked for its parameters: throws a type of its own, whose code lies in
/// this library.

#include <stdexcept>

#include "maggic/plugin.hpp"

namespace {

class OwnError final : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ThrowingDescribe final : public maggic::Tracker {
 public:
  void describe(maggic::Parameters& /*parameters*/) override { throw OwnError("lost for words"); }
  void track(const maggic::TrackerInput& /*input*/, maggic::Detections& /*out*/) override {}
};

}  // namespace

MAGGIC_PLUGIN(ThrowingDescribe, "throws when it is asked for its parameters")
