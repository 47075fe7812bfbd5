/// Broken on purpose: its bounds are right for cubes of colours alone.

#include <algorithm>

#include "maggic/plugin.hpp"

namespace {

class CubesOnlyNormalizer final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::copy(in.r, out.r.begin());
  }

  maggic::ColorBox bounds(const maggic::ColorBox& in) const override {
    const int side = in.b.last - in.b.first;
    return {in.b, from(in.g.first, side), from(in.r.first, side)};
  }

 private:
  static maggic::ChannelRange from(std::uint8_t first, int side) {
    return {first, static_cast<std::uint8_t>(std::min(first + side, 255))};
  }
};

}  // namespace

MAGGIC_PLUGIN(CubesOnlyNormalizer, "takes every box for a cube")
