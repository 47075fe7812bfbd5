#pragma once
/// From runs to blobs: connected regions with their statistics.

#include <cstdint>
#include <span>
#include <vector>

#include "maggic/blob.hpp"

namespace maggic {

/// Joins runs into 8-connected blobs of one label by union-find, collecting area, centroid, bounds
/// and second moments in the same pass. Cost follows the number of runs, not of pixels. Keeps its
/// working memory, so one instance serves one frame path.
class BlobExtractor {
 public:
  struct Limits {
    double min_area_px = 1.0;     ///< Smaller blobs are left out.
    double max_area_px = 1.0e12;  ///< Larger ones too.
    std::size_t max_blobs = 4096;  ///< At most so many are given; on noise the largest stay.
  };

  /// Replaces `blobs` by the blobs of `runs`, which must be ordered as `extract_runs` leaves them.
  /// Blobs come in the order of their first run.
  /// @return how many blobs within the area limits were left out because of `max_blobs`.
  std::size_t extract(std::span<const Run> runs, const Limits& limits, std::vector<Blob>& blobs);

 private:
  /// Sums over the pixels of a tree, exact in 64 bits for any frame up to 65535 a side.
  struct Sums {
    Label label;
    std::uint16_t min_x, max_x, min_y, max_y;
    std::uint64_t count, x, y;
    // Second moments are taken about the tree's first pixel so that they stay exact when moved.
    std::int64_t origin_x, origin_y;
    double xx, yy, xy;
  };
  std::vector<std::uint32_t> parent_;
  std::vector<Sums> sums_;
  std::vector<Blob> scratch_;
};

}  // namespace maggic
