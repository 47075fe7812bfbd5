/// Broken on purpose: gives a whole box the label of its darkest colour.

#include "maggic/plugin.hpp"

namespace {

class HastySegmenter final : public maggic::ColorSegmenter {
 public:
  void segment(const maggic::ColorBatch& original, const maggic::ColorBatch& /*normalized*/,
               std::span<maggic::Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = label_of_red(original.r[i]);
  }

  std::optional<maggic::Label> label_of(const maggic::ColorBox& original,
                                        const maggic::ColorBox& /*normalized*/) const override {
    return label_of_red(original.r.first);
  }

 private:
  static maggic::Label label_of_red(std::uint8_t red) {
    return red > 130 ? 1 : maggic::kBackground;
  }
};

}  // namespace

MAGGIC_PLUGIN(HastySegmenter, "looks at one colour of a box")
