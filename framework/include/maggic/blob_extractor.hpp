#pragma once
/// From runs to blobs: connected regions with their statistics.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maggic/blob.hpp"
#include "maggic/longest_runs.hpp"

namespace maggic {

/// Joins runs into 8-connected blobs of one label by union-find and sums up their area, centroid,
/// bounds and second moments. Cost follows the number of runs, not of pixels, and is bounded. Keeps
/// its working memory, so one instance serves one frame path.
class BlobExtractor {
 public:
  struct Limits {
    double min_area_px = 1.0;     ///< Smaller blobs are left out.
    double max_area_px = 1.0e12;  ///< Larger ones too.
    /// At most so many, at least 1, are given; on noise the largest stay.
    std::size_t max_blobs = 4096;
    /// At most so many runs, at least 1, are looked at; on noise the longest stay: see LongestRuns.
    std::size_t max_runs = 32768;
  };

  /// What the two caps took away.
  struct LeftOut {
    std::size_t blobs = 0;  ///< So many within the area limits, because of `max_blobs`.
    /// All runs of fewer pixels, because of `max_runs`; 1: none.
    int runs_shorter_than_px = 1;
  };

  /// Replaces `blobs` by the blobs of `runs`, which must be ordered as RunScanner leaves them.
  /// Blobs come in the order of their first run.
  LeftOut extract(std::span<const Run> runs, const Limits& limits, std::vector<Blob>& blobs);

 private:
  /// Sums over the pixels of one blob, exact for any frame up to 65535 a side: the largest, of 3x²,
  /// stays below 2^64.
  struct Sums {
    std::uint64_t count = 0, x = 0, y = 0, xx_times_3 = 0, yy = 0, xy = 0;
    std::uint16_t min_x, end_x, min_y, max_y;
    Label label;

    explicit Sums(const Run& first);
    /// @param run not above an earlier one.
    void add(const Run& run);
    Blob to_blob() const;
  };

  void join_touching(std::span<const Run> runs);
  void add_up_areas(std::span<const Run> runs);
  std::size_t choose(const Limits& limits);
  std::size_t keep_largest(std::size_t most);
  void sum_up(std::span<const Run> runs);

  LongestRuns longest_runs_;
  std::vector<std::uint32_t> parent_;      ///< By run: its tree; later its region's first run.
  std::vector<std::uint32_t> area_px_;     ///< By a region's first run; 0 for other runs.
  std::vector<std::uint32_t> first_runs_;  ///< Of all regions, ascending.
  std::vector<std::uint32_t> chosen_;      ///< Those of regions that become blobs, ascending.
  std::vector<std::uint32_t> chosen_areas_px_;
  std::vector<std::uint32_t> blob_of_;  ///< By a region's first run: its blob, or kLeftOut.
  std::vector<Sums> sums_;              ///< By blob.
};

}  // namespace maggic
