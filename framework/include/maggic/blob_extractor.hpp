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

  /// Replaces `blobs` by the blobs of `runs`, which must be ordered as RunScanner leaves them.
  /// Blobs come in the order of their first run.
  /// @return how many blobs within the area limits were left out because of `max_blobs`.
  std::size_t extract(std::span<const Run> runs, const Limits& limits, std::vector<Blob>& blobs);

 private:
  /// Sums over the pixels of one blob, exact for any frame up to 65535 a side: the largest, of x²,
  /// stays below 2^63.
  struct Sums {
    std::uint64_t count = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    std::uint16_t min_x = 65535, max_x = 0, min_y = 65535, max_y = 0;
    Label label = kBackground;

    void add(const Run& run);
    Blob to_blob() const;
  };

  void join_touching(std::span<const Run> runs);
  std::size_t number_components(std::span<const Run> runs);
  std::size_t choose(const Limits& limits);

  std::vector<std::uint32_t> parent_;     ///< By run: its tree; after numbering, its component.
  std::vector<std::uint64_t> area_px_;    ///< By component.
  std::vector<std::uint32_t> chosen_;     ///< Components that become blobs, ascending.
  std::vector<std::uint32_t> blob_of_;    ///< By component: index of its blob, or kLeftOut.
  std::vector<Sums> sums_;                ///< By blob.
};

}  // namespace maggic
