/// Broken on purpose: a label that is no colour of the palette.

#include "maggic/plugin.hpp"

namespace {

class ForeignLabelSegmenter final : public maggic::ColorSegmenter {
 public:
  void segment(const maggic::ColorBatch& original, const maggic::ColorBatch& /*normalized*/,
               std::span<maggic::Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = original.r[i] > 127 ? maggic::Label{200} : maggic::kBackground;
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(ForeignLabelSegmenter, "writes labels out of the palette")
