/// Broken on purpose: works in blocks of 8 and writes the last one whole.

#include "maggic/plugin.hpp"

namespace {

class OverrunningNormalizer final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    const std::size_t blocks_end = (in.size() + 7) / 8 * 8;
    for (std::size_t i = 0; i < blocks_end; ++i) {
      const std::size_t from = i < in.size() ? i : 0;
      out.b.data()[i] = in.b.data()[from];
      out.g.data()[i] = in.g.data()[from];
      out.r.data()[i] = in.r.data()[from];
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(OverrunningNormalizer, "writes beyond the end of a batch")
