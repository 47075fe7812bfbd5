/// none: leaves every colour as it is
/// ==================================
///
/// What it does: the normalised colour is the original colour.
/// When to use it: with `yuv_boxes`, which then works as the teams' legacy programs do; or to see
/// what another normalizer gains.
///
///     normalizer: none
///
/// No parameters.

#include <algorithm>

#include "maggic/plugin.hpp"

namespace {

class None final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::copy(in.r, out.r.begin());
  }

  maggic::ColorBox bounds(const maggic::ColorBox& in) const override { return in; }
};

}  // namespace

MAGGIC_PLUGIN(None, "leaves every colour as it is")
