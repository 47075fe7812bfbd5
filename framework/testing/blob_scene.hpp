#pragma once
/// Blobs to feed trackers with: tags that move, and clutter.

#include <chrono>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/blob.hpp"
#include "maggic/frame.hpp"
#include "maggic/palette.hpp"

namespace maggic::testing {

struct BlobFrame {
  /// 0.43 px/mm on the small field, camera 2 m up: a robot's tag is about 32 px wide.
  static inline const cv::Size kSize{640, 480};

  Timestamp captured{0};
  std::vector<Blob> blobs;  ///< No two with one centroid.
};

/// The same frames in every run: none, one, then many blobs; two-tag and three-tag robots of both
/// teams, some with the same colours; specks, huge blobs and blobs at the very corner; and times
/// that stand still, jump ahead and go backwards.
std::vector<BlobFrame> blob_scene(const Palette& palette);

}  // namespace maggic::testing
