#include "bounds_contract.hpp"
#include "color_contract.hpp"
#include "conformance.hpp"
#include "image_contract.hpp"

namespace maggic::testing {
namespace {

ColorFunction as_function(const ColorSegmenter& segmenter) {
  return {6, 1, standard_palette().size(), [&segmenter](InputPlanes in, OutputPlanes out) {
            segmenter.segment({in[0], in[1], in[2]}, {in[3], in[4], in[5]}, out[0]);
          }};
}

ImageFunction as_function(ImageSegmenter& segmenter) {
  return {2, CV_8UC1, static_cast<int>(standard_palette().size()),
          [&segmenter](const std::vector<cv::Mat>& in, cv::Mat& out) {
            segmenter.segment(in[0], in[1], out);
          }};
}

}  // namespace

void check_segmenter(const Maker<Segmenter>& make, Findings& findings) {
  const StagePtr<Segmenter> first = make();
  const StagePtr<Segmenter> second = make();
  if (const auto* color = dynamic_cast<const ColorSegmenter*>(first.get())) {
    check_color_function(as_function(*color),
                         as_function(dynamic_cast<const ColorSegmenter&>(*second)), findings);
    check_label_of(*color, findings);
  } else if (auto* image = dynamic_cast<ImageSegmenter*>(first.get())) {
    check_image_function(as_function(*image), as_function(dynamic_cast<ImageSegmenter&>(*second)),
                         findings);
  } else {
    findings.add("derives from Segmenter itself, expected ColorSegmenter or ImageSegmenter");
  }
}

}  // namespace maggic::testing
