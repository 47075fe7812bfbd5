#pragma once
/// The runs of a picture of labels, read pixel by pixel as the contract's words have it: what the
/// scan is compared with.

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/blob.hpp"
#include "maggic/scan_area.hpp"

namespace maggic {

inline std::vector<Run> plain_runs(const cv::Mat& labels, const ScanArea& area) {
  std::vector<Run> runs;
  for (const RowSpan& span : area) {
    for (std::uint16_t x = span.begin; x < span.end; ++x) {
      const Label label = labels.at<Label>(span.row, x);
      if (label == kBackground) continue;
      if (x > span.begin && labels.at<Label>(span.row, x - 1) == label) {
        ++runs.back().end;
      } else {
        runs.push_back({span.row, x, static_cast<std::uint16_t>(x + 1), label});
      }
    }
  }
  return runs;
}

}  // namespace maggic
