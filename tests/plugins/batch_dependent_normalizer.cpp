/// Broken on purpose: the last, odd colours of a batch get another answer.

#include "maggic/plugin.hpp"

namespace {

class BatchDependentNormalizer final : public maggic::ColorNormalizer {
 public:
  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    const std::size_t whole_vectors = in.size() / 16 * 16;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const int too_dark = i < whole_vectors ? 0 : 1;
      out.b[i] = static_cast<std::uint8_t>(in.b[i] >> too_dark);
      out.g[i] = static_cast<std::uint8_t>(in.g[i] >> too_dark);
      out.r[i] = static_cast<std::uint8_t>(in.r[i] >> too_dark);
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(BatchDependentNormalizer, "answers differently at the end of a batch")
