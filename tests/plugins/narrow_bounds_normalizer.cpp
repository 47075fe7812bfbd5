/// Broken on purpose: its bounds take no notice of how far red reaches.

#include "maggic/plugin.hpp"

namespace {

class NarrowBoundsNormalizer final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.b[i] = static_cast<std::uint8_t>(in.b[i] / 2);
      out.g[i] = static_cast<std::uint8_t>(in.g[i] / 2);
      out.r[i] = static_cast<std::uint8_t>(in.r[i] / 2);
    }
  }

  maggic::ColorBox bounds(const maggic::ColorBox& in) const override {
    return {halved(in.b),
            halved(in.g),
            {static_cast<std::uint8_t>(in.r.first / 2), static_cast<std::uint8_t>(in.r.first / 2)}};
  }

 private:
  static maggic::ChannelRange halved(maggic::ChannelRange range) {
    return {static_cast<std::uint8_t>(range.first / 2), static_cast<std::uint8_t>(range.last / 2)};
  }
};

}  // namespace

MAGGIC_PLUGIN(NarrowBoundsNormalizer, "says less than its results span")
