#include "bounds_contract.hpp"
#include "color_contract.hpp"
#include "conformance.hpp"
#include "image_contract.hpp"

namespace maggic::testing {
namespace {

ColorFunction as_function(const ColorNormalizer& normalizer) {
  return {3, 3, 256, [&normalizer](InputPlanes in, OutputPlanes out) {
            normalizer.normalize({in[0], in[1], in[2]}, {out[0], out[1], out[2]});
          }};
}

ImageFunction as_function(ImageNormalizer& normalizer) {
  return {1, CV_8UC3, 256, [&normalizer](const std::vector<cv::Mat>& in, cv::Mat& out) {
            normalizer.normalize(in[0], out);
          }};
}

}  // namespace

void check_normalizer(const Maker<Normalizer>& make, Findings& findings) {
  const StagePtr<Normalizer> first = make();
  const StagePtr<Normalizer> second = make();
  if (const auto* color = dynamic_cast<const ColorNormalizer*>(first.get())) {
    check_color_function(as_function(*color),
                         as_function(dynamic_cast<const ColorNormalizer&>(*second)), findings);
    check_bounds(*color, findings);
  } else if (auto* image = dynamic_cast<ImageNormalizer*>(first.get())) {
    check_image_function(as_function(*image), as_function(dynamic_cast<ImageNormalizer&>(*second)),
                         findings);
  } else {
    findings.add("derives from Normalizer itself, expected ColorNormalizer or ImageNormalizer");
  }
}

}  // namespace maggic::testing
