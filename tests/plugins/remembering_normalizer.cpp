/// Broken on purpose: an answer depends on how often it was asked.

#include <algorithm>
#include <atomic>

#include "maggic/plugin.hpp"

namespace {

class RememberingNormalizer final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    ++calls_;
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::fill(out.r, static_cast<std::uint8_t>(calls_));
  }

 private:
  mutable std::atomic<unsigned> calls_{0};
};

}  // namespace

MAGGIC_PLUGIN(RememberingNormalizer, "answers by the number of calls")
